// Colours of RAPID text. Comments, strings and names end with their line, so each line is split on its own.

export interface Token {
    kind: "keyword" | "type" | "number" | "string" | "comment" | "call" | "constant" | "plain";
    text: string;
}

const keywords = new Set(
    ("MODULE ENDMODULE PROC ENDPROC FUNC ENDFUNC TRAP ENDTRAP RECORD ENDRECORD LOCAL TASK VAR PERS CONST ALIAS IF THEN ELSE ELSEIF ENDIF " +
        "FOR FROM TO STEP DO ENDFOR WHILE ENDWHILE TEST CASE DEFAULT ENDTEST RETURN EXIT GOTO RAISE RETRY TRYNEXT CONNECT WITH ERROR UNDO " +
        "BACKWARD AND OR NOT XOR DIV MOD INOUT SYSMODULE NOSTEPIN VIEWONLY READONLY NOVIEW").split(" "),
);
const types = new Set(
    ("num dnum bool string robtarget jointtarget tooldata wobjdata speeddata zonedata pos orient pose confdata extjoint robjoint loaddata " +
        "clock intnum signaldi signaldo signalgi signalgo signalai signalao socketdev errnum byte rawbytes iodev btnres icondata " +
        "triggdata stoppointdata wzstationary wztemporary shapedata tpnum datapos identno").split(" "),
);
const constants = new Set(["true", "false", "pi", "fine", "stempty", "wobj0", "tool0", "load0", "errno"]);
const pattern = /!.*$|"(?:[^"]|"")*"?|\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|[A-Za-z_\u00c0-\u024f][\w\u00c0-\u024f]*|\s+|[^\w\s"!]+/g;

export function tokensOf(line: string): Token[] {
    const tokens: Token[] = [];
    let first = true;
    for (const [text] of line.matchAll(pattern)) {
        const kind = kindOf(text, first);
        if (text.trim() !== "") first = false;
        const last = tokens[tokens.length - 1];
        if (last && last.kind === kind) last.text += text;
        else tokens.push({ kind, text });
    }
    return tokens;
}

function kindOf(text: string, first: boolean): Token["kind"] {
    if (text.startsWith("!")) return "comment";
    if (text.startsWith('"')) return "string";
    if (/^\d/.test(text)) return "number";
    if (!/^[A-Za-z_\u00c0]/.test(text)) return "plain";
    if (keywords.has(text.toUpperCase())) return "keyword";
    const lower = text.toLowerCase();
    if (types.has(lower)) return "type";
    if (constants.has(lower) || /^[vz]\d+$/.test(lower)) return "constant";
    return first && /^[A-Z]/.test(text) ? "call" : "plain";
}
