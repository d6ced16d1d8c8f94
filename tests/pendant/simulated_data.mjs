// What the simulated controller knows: modules, signals, data, messages.

export const mainModule = `MODULE PickAndPlace
    ! Takes parts from the tray and puts them on the table.
    PERS tooldata tGripper := [TRUE, [[0, 0, 120], [1, 0, 0, 0]], [1, [0, 0, 40], [1, 0, 0, 0], 0, 0, 0]];
    TASK PERS wobjdata wobjTable := [FALSE, TRUE, "", [[380, 120, 50], [1, 0, 0, 0]], [[0, 0, 0], [1, 0, 0, 0]]];
    CONST robtarget pHome := [[60, -120, 320], [0, 0, 1, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];
    CONST robtarget pPick := [[0, 40, 20], [0, 0, 1, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];
    CONST robtarget pPlace := [[120, 180, 35], [0, 0, 1, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];
    PERS num nParts := 12;
    VAR bool bReady := FALSE;

    PROC main()
        MoveJ pHome, v1000, z50, tGripper \\WObj:=wobjTable;
        WHILE TRUE DO
            WaitDI diPartReady, 1;
            Pick;
            Place;
            nParts := nParts + 1;
            TPWrite "Parts: " \\Num:=nParts;
        ENDWHILE
    ENDPROC

    PROC Pick()
        MoveJ Offs(pPick, 0, 0, 100), v1000, z20, tGripper \\WObj:=wobjTable;
        MoveL pPick, v200, fine, tGripper \\WObj:=wobjTable;
        SetDO doGripper, 1;
        WaitTime 0.2;
        MoveL Offs(pPick, 0, 0, 100), v500, z20, tGripper \\WObj:=wobjTable;
    ENDPROC

    PROC Place()
        MoveJ Offs(pPlace, 0, 0, 80), v1000, z20, tGripper \\WObj:=wobjTable;
        MoveL pPlace, v200, fine, tGripper \\WObj:=wobjTable;
        SetDO doGripper, 0;
        MoveL Offs(pPlace, 0, 0, 80), v500, z20, tGripper \\WObj:=wobjTable;
    ENDPROC
ENDMODULE
`;
export const systemModule = "MODULE Cell(SYSMODULE)\n    PERS num nSpeed := 80;\n    PROC Reset()\n        nSpeed := 80;\n    ENDPROC\nENDMODULE\n";

const signal = (name, type, value, more = {}) => ({
    name, type, value, simulated: false, device: "", label: "", category: "", min: 0, max: type[0] === "D" ? 1 : 100, writable: true, ...more,
});
export function makeSignals() {
    const named = [
        signal("diPartReady", "DI", 1, { label: "A part lies on the tray", category: "cell" }),
        signal("diDoorClosed", "DI", 1, { device: "D652_10", category: "safety" }),
        signal("doGripper", "DO", 0, { device: "D652_10", label: "Gripper closes" }),
        signal("doCycleOn", "DO", 1, { writable: false, category: "system" }),
        signal("aiPressure", "AI", 5.75, { min: 0, max: 10, label: "bar" }),
        signal("aoFeed", "AO", 42.5, { max: 100 }),
        signal("giRecipe", "GI", 7, { max: 255, simulated: true }),
        signal("goStatus", "GO", 3, { max: 15 }),
    ];
    const many = Array.from({ length: 60 }, (_, i) => signal(`di_station_${String(i + 1).padStart(2, "0")}`, i % 2 ? "DO" : "DI", i % 3 ? 0 : 1, { device: "PN_1" }));
    return [...named, ...many];
}

const datum = (name, type, kind, value, more = {}) => ({
    path: `T_ROB1/PickAndPlace/${name}`, module: "PickAndPlace", name, type, kind, dims: [], local: false, readOnly: kind === "const", line: 3, value, ...more,
});
export function makeData() {
    const target = "[[120,180,35],[0,0,1,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]";
    return [
        datum("nParts", "num", "pers", "12", { line: 8 }),
        datum("bReady", "bool", "var", "FALSE", { line: 9 }),
        datum("pHome", "robtarget", "const", target, { line: 5 }),
        datum("pPick", "robtarget", "const", target, { line: 6 }),
        datum("pPlace", "robtarget", "const", target, { line: 7 }),
        datum("tGripper", "tooldata", "pers", "[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,40],[1,0,0,0],0,0,0]]", { line: 3 }),
        datum("wobjTable", "wobjdata", "pers", '[FALSE,TRUE,"",[[380,120,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]', { line: 4 }),
        ...Array.from({ length: 30 }, (_, i) => datum(`nCounter${i + 1}`, "num", "var", String(i * 3))),
    ];
}

const titles = [
    [10002, "state", "Program pointer has been reset"], [10010, "state", "Motors OFF state"], [10011, "state", "Motors ON state"],
    [10150, "state", "Program started"], [40228, "error", "Execution error: division by zero"], [50024, "warning", "Corner path failure"],
    [10125, "state", "Program stopped"],
];
export const makeEvents = () => Array.from({ length: 40 }, (_, i) => {
    const [code, type, title] = titles[i % titles.length];
    const minute = String(Math.floor(i / 2)).padStart(2, "0");
    return { number: i + 1, code, type, title, time: `2026-11-25 T 14:${minute}:${i % 2 ? "30" : "00"}`, task: i % 3 ? "T_ROB1" : "" };
}).reverse();

export const zones = [
    { name: "wzTable", kind: "box", active: true, inside: true, stops: true, signal: "", box: { from: [300, -250, -20], to: [620, 250, 30] } },
    { name: "wzHome", kind: "sphere", active: true, inside: true, stops: false, signal: "doCycleOn", sphere: { centre: [300, -180, 460], radius: 90 } },
    { name: "wzPost", kind: "cylinder", active: true, inside: true, stops: true, signal: "", cylinder: { centre: [-260, 320, 0], radius: 70, height: 640 } },
];

const dialog = (id, kind, more) => ({
    id, kind, task: "T_ROB1", instruction: "UIMsgBox", header: "Gripper", lines: [], icon: "", choices: [], items: [], initial: "", ...more,
});
export const dialogs = {
    choice: dialog(1, "choice", { icon: "Warning", lines: ["The gripper is empty.", "Put a part in and continue?"], choices: ["Yes", "", "No"] }),
    number: dialog(2, "number", { instruction: "UINumEntry", lines: ["How many parts?"], initial: "5", minimum: 1, maximum: 99, wholeNumbers: true }),
    text: dialog(3, "text", { instruction: "UIAlphaEntry", lines: ["Name of the batch"], initial: "B-17" }),
    list: dialog(4, "list", { instruction: "UIListView", lines: ["Recipe"], items: ["Cube", "Cylinder", "Plate"], choices: ["OK", "Cancel"] }),
};
