// node build.mjs FOLDER [--plain]: bundles the page into FOLDER; each file also as .gz, for the executable.

import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? "dist");
const plain = process.argv.includes("--plain");

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
await build({
    entryPoints: { app: join(here, "src/main.ts"), style: join(here, "styles/main.css") },
    outdir: folder,
    external: ["icon.svg"],
    bundle: true,
    format: "esm",
    target: ["chrome105", "firefox110", "safari16"],
    minify: !plain,
    sourcemap: plain ? "linked" : false,
    legalComments: "none",
    logLevel: "warning",
});
writeFileSync(join(folder, "index.html"), readFileSync(join(here, "index.html")));
writeFileSync(join(folder, "icon.svg"), readFileSync(join(here, "icon.svg")));
writeFileSync(join(folder, "licences.txt"), licences());
for (const name of ["index.html", "app.js", "style.css", "icon.svg", "licences.txt"]) {
    const bytes = readFileSync(join(folder, name));
    writeFileSync(join(folder, `${name}.gz`), gzipSync(bytes, { level: 9 })); // without a time: the same input gives the same bytes
}

/** The texts that the licences of bundled packages ask to be kept. */
function licences() {
    const names = Object.keys(JSON.parse(readFileSync(join(here, "package.json"), "utf8")).dependencies);
    return names.map((name) => `${name}\n\n${readFileSync(join(here, "node_modules", name, "LICENSE"), "utf8")}`).join("\n");
}
