// The TextMate grammar against the rules of the language: every keyword of the lexer, the forms of literals in frontend/rapid.ebnf, and
// whole modules, token by token, as `rapidc emit --as=tokens` reads them.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const require = createRequire(import.meta.url);
const { Registry, parseRawGrammar, INITIAL } = require("vscode-textmate");
const oniguruma = require("vscode-oniguruma");

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "../../..");
await oniguruma.loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
const registry = new Registry({
    onigLib: Promise.resolve({
        createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
        createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async (scope) => {
        const name = scope === "source.rapid" ? "rapid" : "abb-cfg";
        const path = join(here, `../syntaxes/${name}.tmLanguage.json`);
        return parseRawGrammar(readFileSync(path, "utf8"), path);
    },
});
const rapid = await registry.loadGrammar("source.rapid");
const cfg = await registry.loadGrammar("source.abb-cfg");

/** [line][token]: text and innermost scope. */
function tokens(text, grammar = rapid) {
    let state = INITIAL;
    return text.split("\n").map((line) => {
        const result = grammar.tokenizeLine(line, state);
        state = result.ruleStack;
        return result.tokens.map((t) => ({ from: t.startIndex, to: t.endIndex, text: line.slice(t.startIndex, t.endIndex), scopes: t.scopes }));
    });
}

/** All scopes at a place of a line, as one text. */
function scopesAt(lines, line, column) {
    return (lines[line] ?? []).find((t) => t.from <= column && column < t.to)?.scopes.join(" ") ?? "";
}

/** The scopes of the first occurrence of `word` in `text`. */
function scopesOf(text, word) {
    const lines = text.split("\n");
    const line = lines.findIndex((l) => l.includes(word));
    return scopesAt(tokens(text), line, lines[line].indexOf(word));
}

const keywords = [...readFileSync(join(root, "frontend/syntax/token_kinds.def"), "utf8").matchAll(/^KEYWORD\(\w+, "(\w+)"\)/gm)].map((m) => m[1]);

test("every keyword of the language is one, in any case", () => {
    assert.ok(keywords.length > 50);
    for (const keyword of keywords)
        for (const word of [keyword, keyword.toLowerCase(), keyword[0] + keyword.slice(1).toLowerCase()]) {
            // the attributes of a module stand in its parentheses, modes of parameters in those of a routine
            const text = /^(SYSMODULE|NOVIEW|NOSTEPIN|VIEWONLY|READONLY)$/.test(keyword) ? `MODULE m(${word})`
                : keyword === "INOUT" ? `PROC p(${word} num n)`
                : keyword === "RECORD" || keyword === "ENDRECORD" ? "RECORD part\n num a;\nENDRECORD".replace(keyword, word)
                : keyword === "ALIAS" ? `${word} num level;` : `  ${word} `;
            assert.match(scopesOf(text, word), /\b(keyword|storage|constant\.language)\./, word);
        }
});

test("a name that contains a keyword is a name", () => {
    for (const word of ["ifdone", "do_it", "endproc1", "x_mod", "Ford"])
        assert.doesNotMatch(scopesOf(`x := ${word} + 1;`, word), /keyword\.(?!operator\.(assign|arith))|storage/, word);
});

test("numbers in all forms of the grammar", () => {
    for (const number of ["0", "12", "3.", "3.14", ".5", "1E3", "1e-10", "1.5E+06", "9E9", "0x1F", "0XFF", "0o17", "0b1010"]) {
        const line = tokens(`x := ${number};`)[0];
        const token = line.find((t) => t.from <= 5 && 5 < t.to);
        assert.equal(token.text, number);
        assert.match(token.scopes.join(" "), /constant\.numeric/, number);
    }
    assert.doesNotMatch(scopesOf("x := p10;", "p10"), /constant\.numeric/);
});

test("strings: doubled quotes, codes, the end of the line", () => {
    const text = 'TPWrite "a ""quoted"" \\0A \\\\ ! no comment"; ! comment';
    const line = tokens(text)[0];
    for (let i = text.indexOf('"'); i < text.indexOf(";"); ++i) assert.match(scopesAt([line], 0, i), /string\.quoted/);
    assert.match(scopesOf(text, "\\0A"), /constant\.character\.escape/);
    assert.match(scopesOf(text, '""'), /constant\.character\.escape/);
    assert.match(scopesOf(text, "! comment"), /comment\.line/);
    // a string ends where its line ends
    assert.doesNotMatch(scopesAt(tokens('x := "open\nMoveL p1;'), 1, 0), /string/);
});

test("declarations: types and names", () => {
    const text = 'LOCAL PERS tooldata tGripper := [TRUE];\nFUNC robtarget place(num n\\VAR bool ok|switch fast)\nTRAP stop\nRECORD part\n  string name;\nENDRECORD\nALIAS num level;\nMODULE Cell(SYSMODULE, NOSTEPIN)';
    assert.match(scopesOf(text, "tooldata"), /storage\.type/);
    assert.match(scopesOf(text, "tGripper"), /variable\.other\.declaration/);
    assert.match(scopesOf(text, "robtarget"), /storage\.type/);
    assert.match(scopesOf(text, "place"), /entity\.name\.function/);
    assert.match(scopesOf(text, "n\\VAR"), /variable\.parameter/);
    assert.match(scopesOf(text, "ok"), /variable\.parameter/);
    assert.match(scopesOf(text, "fast"), /variable\.parameter/);
    assert.match(scopesOf(text, "stop"), /entity\.name\.function/);
    assert.match(scopesOf(text, "part"), /entity\.name\.type/);
    assert.match(scopesOf(text, "name;"), /variable\.other\.member/);
    assert.match(scopesOf(text, "level"), /entity\.name\.type/);
    assert.match(scopesOf(text, "Cell"), /entity\.name\.type\.module/);
});

test("instructions: calls, optional arguments, labels, late binding, components", () => {
    assert.match(scopesOf("  MoveL p1, v100, z10, tool0 \\WObj:=wobj1;", "MoveL"), /entity\.name\.function\.call/);
    assert.match(scopesOf("  MoveL p1, v100, z10, tool0 \\WObj:=wobj1;", "WObj"), /variable\.parameter\.optional/);
    assert.match(scopesOf("  Stop;", "Stop"), /entity\.name\.function\.call/);
    assert.doesNotMatch(scopesOf("  total := 1;", "total"), /function/);
    assert.doesNotMatch(scopesOf("  list{2} := 1;", "list"), /function/);
    assert.match(scopesOf("again:", "again"), /entity\.name\.label/);
    assert.match(scopesOf("GOTO again;", "again"), /entity\.name\.label/);
    assert.match(scopesOf("x := Offs(p1, 0, 0, 5);", "Offs"), /entity\.name\.function\.call/);
    assert.match(scopesOf("x := p1.trans.z;", "trans"), /variable\.other\.member/);
    assert.match(scopesOf('%"proc" + NumToStr(1, 0)%;', "%"), /keyword\.operator\.latebinding/);
    assert.match(scopesOf("<SMT>", "<SMT>"), /placeholder/);
    assert.match(scopesOf("!! documented", "!!"), /comment\.line\.documentation/);
});

test("configuration", () => {
    const text = 'EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name "di1" -SignalType "DI" -Size 8 \\';
    const lines = tokens(text, cfg);
    assert.match(scopesAt(lines, 0, 0), /keyword\.control\.domain/);
    assert.match(scopesAt(lines, 2, 0), /entity\.name\.section/);
    assert.match(scopesAt(lines, 4, 7), /variable\.other\.member/);
    assert.match(scopesAt(lines, 4, 13), /string\.quoted/);
});

// Every token of real modules, as the lexer of the compiler reads them.
const rapidc = process.env["RAPIDC"] ?? join(root, "build/rapidc");
test("modules of the tests, token by token", { skip: existsSync(rapidc) ? false : "build/rapidc is not there" }, () => {
    const files = ["strings", "errors", "arrays", "motion"].map((name) => join(root, "tests/golden", name)).filter(existsSync)
        .flatMap((folder) => readdirSync(folder).filter((name) => name.endsWith(".modx")).slice(0, 4).map((name) => join(folder, name)));
    let seen = 0;
    for (const file of files) {
        const text = readFileSync(file, "utf8");
        const lines = tokens(text.replace(/\r/g, ""));
        for (const row of execFileSync(rapidc, ["emit", "--as=tokens", file], { encoding: "utf8" }).split("\n")) {
            const found = /^(\d+):(\d+) (\w+)/.exec(row);
            if (!found) continue;
            const [line, column, kind] = [Number(found[1]) - 1, Number(found[2]) - 1, found[3]];
            const scopes = scopesAt(lines, line, column);
            const wanted = kind === "StringLiteral" ? /string\.quoted/ : kind === "NumLiteral" ? /constant\.numeric/
                : kind.startsWith("Kw") ? /\b(keyword|storage|constant\.language)\./ : undefined;
            if (wanted) {
                assert.match(scopes, wanted, `${file}:${line + 1}:${column + 1} ${row}`);
                ++seen;
            }
            if (kind === "Identifier") assert.doesNotMatch(scopes, /string|comment|constant\.numeric|keyword\.control/, `${file}:${line + 1}:${column + 1} ${row}`);
        }
    }
    assert.ok(seen > 200, `${seen} tokens`);
});
