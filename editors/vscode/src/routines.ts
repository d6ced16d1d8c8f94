// Routines in the text of a module and in what the compiler writes. Free of the editor, so that it is tested without one.

const head = /^\s*(?:LOCAL\s+)?(?:PROC|FUNC\s+\w+|TRAP)\s+(\w+)/i;
const end = /^\s*END(?:PROC|FUNC|TRAP)\b/i;

/** The routine around a line (from 0), or undefined between routines. */
export function routineAt(text: string, line: number): string | undefined {
    const lines = text.split("\n");
    for (let at = Math.min(line, lines.length - 1); at >= 0; --at) {
        const found = head.exec(lines[at] ?? "");
        if (found) return found[1];
        if (at < line && end.test(lines[at] ?? "")) return undefined;
    }
    return undefined;
}

function isNamed(line: string, routine: string): boolean {
    const name = routine.replace(/[^\w]/g, "").toLowerCase();
    return new RegExp(`/${name}(?:"|\\b|$)`).test(line.toLowerCase());
}

/** The part of the IR or the assembly that belongs to a routine; undefined when there is none. */
export function sectionOf(text: string, stage: "ir" | "asm", routine: string): string | undefined {
    const lines = text.split("\n");
    const begins = stage === "ir" ? (line: string) => /^routine\b|^define\b/.test(line) : (line: string) => /^"?[\w$./]+"?:/.test(line) && !/^\.?L/.test(line);
    const ends = stage === "ir" ? (line: string) => line.startsWith("}") : (line: string) => /^\.Lfunc_end/.test(line);
    const first = lines.findIndex((line) => begins(line) && isNamed(line, routine));
    if (first < 0) return undefined;
    const length = lines.slice(first).findIndex(ends);
    return lines.slice(first, length < 0 ? undefined : first + length + 1).join("\n") + "\n";
}
