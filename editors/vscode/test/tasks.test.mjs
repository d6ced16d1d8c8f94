// The problem matcher finds the messages of rapidc in the output of a task.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const { contributes } = JSON.parse(readFileSync(join(here, "../package.json"), "utf8"));
const { pattern } = contributes.problemMatchers.find((matcher) => matcher.name === "rapidc");

/** What the matcher takes from a line; undefined: not a message. */
function message(line) {
    const found = new RegExp(pattern.regexp).exec(line);
    return found && ["file", "line", "column", "severity", "code", "message"].map((part) => found[pattern[part]]);
}

test("a message: file:line:column: severity[code]: text", () => {
    assert.deepEqual(message("/cell/main.modx:12:5: error[RAP2001]: 'above' is not declared"),
        ["/cell/main.modx", "12", "5", "error", "RAP2001", "'above' is not declared"]);
    assert.deepEqual(message("C:\\cell\\main.mod:1:1: warning[RAP8003]: 'n': not used (unused)"),
        ["C:\\cell\\main.mod", "1", "1", "warning", "RAP8003", "'n': not used (unused)"]);
    assert.deepEqual(message("main.modx:3:7: note: 'n' is declared here"), ["main.modx", "3", "7", "note", undefined, "'n' is declared here"]);
});

test("other lines of the output", () => {
    for (const line of ["   12 |     MoveL above;", "      |           ^~~~~", "1 error", "[0.000 s] error 40229: Unhandled error", "    at T_ROB1 M:7 in main"])
        assert.equal(message(line), null, line);
});
