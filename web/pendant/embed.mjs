// node embed.mjs FOLDER OUTPUT.cpp: writes the compressed files of a bundle as a C++ source for the executable.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [folder, output] = process.argv.slice(2);
const files = [
    ["/", "index.html", "text/html;charset=utf-8"],
    ["/app.js", "app.js", "text/javascript;charset=utf-8"],
    ["/style.css", "style.css", "text/css;charset=utf-8"],
    ["/icon.svg", "icon.svg", "image/svg+xml"],
    ["/licences.txt", "licences.txt", "text/plain;charset=utf-8"],
];
const bytesPerLine = 32;

/** A string literal: three octal digits for each byte, so that no digit after it can belong to it. */
function literal(bytes) {
    const lines = [];
    for (let at = 0; at < bytes.length; at += bytesPerLine) {
        const line = Array.from(bytes.subarray(at, at + bytesPerLine), (byte) => `\\${byte.toString(8).padStart(3, "0")}`);
        lines.push(`    "${line.join("")}"`);
    }
    return lines.join("\n");
}

const parts = ['// Generated from web/pendant.\n#include "tools/pendant/page_files.h"\n\nnamespace rapidc::pendant {\n\nnamespace {\n'];
const rows = [];
files.forEach(([path, name, type], index) => {
    const bytes = readFileSync(join(folder, `${name}.gz`));
    parts.push(`constexpr char kBytes${index}[] =\n${literal(bytes)};\n`);
    rows.push(`    {"${path}", "${type}", std::string_view(kBytes${index}, ${bytes.length}), true},`);
});
parts.push(`constexpr PageFile kFiles[] = {\n${rows.join("\n")}\n};\n\n} // namespace\n`);
parts.push("PageFiles builtPage() {\n    return kFiles;\n}\n\n} // namespace rapidc::pendant\n");
writeFileSync(output, parts.join("\n"));
