// Finding the routine around the cursor, and its part in what the compiler writes.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const { transformSync } = createRequire(import.meta.url)("esbuild");
const here = dirname(fileURLToPath(import.meta.url));
const code = transformSync(readFileSync(join(here, "../src/routines.ts"), "utf8"), { loader: "ts", format: "esm" }).code;
const { routineAt, sectionOf } = await import(`data:text/javascript,${encodeURIComponent(code)}`);

const text = "MODULE M\n  PROC main()\n    go;\n  ENDPROC\n\n  LOCAL FUNC num half(num n)\n    RETURN n / 2;\n  ENDFUNC\n  TRAP stop\n  ENDTRAP\nENDMODULE";

test("the routine around a line", () => {
    assert.equal(routineAt(text, 0), undefined);
    assert.equal(routineAt(text, 1), "main");
    assert.equal(routineAt(text, 2), "main");
    assert.equal(routineAt(text, 3), "main");
    assert.equal(routineAt(text, 4), undefined);
    assert.equal(routineAt(text, 6), "half");
    assert.equal(routineAt(text, 8), "stop");
    assert.equal(routineAt(text, 1000), undefined);
});

test("the part of a routine", () => {
    const ir = 'module "m"\nroutine @"T_ROB1/M/main"() {\n  b0:\n}\nroutine @"T_ROB1/M/half"(f32) {\n  b0:\n  ret\n}\n';
    assert.equal(sectionOf(ir, "ir", "HALF"), 'routine @"T_ROB1/M/half"(f32) {\n  b0:\n  ret\n}\n');
    assert.equal(sectionOf(ir, "ir", "hal"), undefined);
});
