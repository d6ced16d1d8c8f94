// The cell of the simulated server: two robots, a program, signals, data, events.

const none = [0, 0, 0, 1, 0, 0, 0];
const shift = (x, y, z) => [x, y, z, 1, 0, 0, 0];
const capsule = (from, to, radius, role = "arm") => ({ kind: "capsule", from, to, radius, role });
const cylinder = (from, to, radius, role = "joint") => ({ kind: "cylinder", from, to, radius, role });

const body = (name, parent, origin, axis, joint, solids) => ({
    name, parent, origin, axis, motion: joint === null ? "fixed" : "rotary", constant: 0, terms: joint === null ? [] : [[joint, 1]], solids,
});

/** An arm of 6 axes with the lengths of IRB 120: 290, 270, 70, 302, 72 mm. */
function bodies() {
    return [
        body("base", -1, none, [0, 0, 1], null, [cylinder([0, 0, 0], [0, 0, 110], 92), cylinder([0, 0, 0], [0, 0, 18], 120, "flange")]),
        body("link1", 0, shift(0, 0, 110), [0, 0, 1], 0, [capsule([0, 0, 20], [0, 0, 150], 74), cylinder([0, -85, 180], [0, 85, 180], 62)]),
        body("link2", 1, shift(0, 0, 180), [0, 1, 0], 1, [capsule([0, 0, 0], [0, 0, 270], 52), cylinder([0, -68, 270], [0, 68, 270], 50)]),
        body("link3", 2, shift(0, 0, 270), [0, 1, 0], 2, [capsule([0, 0, 0], [0, 0, 70], 46), capsule([0, 0, 70], [130, 0, 70], 44)]),
        body("link4", 3, shift(0, 0, 70), [1, 0, 0], 3, [cylinder([134, 0, 0], [200, 0, 0], 40), capsule([200, 0, 0], [286, 0, 0], 33)]),
        body("link5", 4, shift(302, 0, 0), [0, 1, 0], 4, [cylinder([0, -36, 0], [0, 36, 0], 34), capsule([0, 0, 0], [40, 0, 0], 26)]),
        body("flange", 5, [72, 0, 0, Math.SQRT1_2, 0, Math.SQRT1_2, 0], [0, 0, 1], 5, [cylinder([0, 0, -14], [0, 0, 0], 25, "flange")]),
    ];
}

const limits = [[-165, 165], [-110, 110], [-110, 70], [-160, 160], [-120, 120], [-400, 400]];

function unit(name, task, base, tool) {
    return {
        name, model: "IRB 120-3/0.58", task, base, toolMass: 1, reach: 580, bodies: bodies(),
        tool: { name: tool, pose: [0, 0, 95, 1, 0, 0, 0] },
        workObject: { name: name === "ROB_1" ? "wTray" : "wobj0", pose: name === "ROB_1" ? [330, 190, 60, 1, 0, 0, 0] : none },
        joints: limits.map(([lower, upper], index) => ({ axis: index + 1, name: String(index + 1), kind: "rotary", lower, upper, maxSpeed: 250 })),
        external: [],
    };
}

export const units = [unit("ROB_1", "T_ROB1", none, "tVacuum"), unit("ROB_2", "T_ROB2", [0, 900, 0, Math.SQRT1_2, 0, 0, -Math.SQRT1_2], "tGripper")];

export const modules = {
    MainModule: `MODULE MainModule
   ! Picks parts from the infeed and fills a tray.
   VAR num partsPlaced:=0;
   PERS robtarget pPick:=[[374,-180,240],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
   PERS tooldata tVacuum:=[TRUE,[[0,0,95],[1,0,0,0]],[1,[0,0,40],[1,0,0,0],0,0,0]];
   CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

   PROC main()
      prepareCell;
      WHILE partsPlaced<6 DO
         pickPart;
         partsPlaced:=partsPlaced+1;
         TPWrite "Part "+NumToStr(partsPlaced,0)+" placed";
         placePart Offs(pPick,0,120*partsPlaced,0),wTray\\gently;
         SetGO goPlaced,partsPlaced;
      ENDWHILE
      MoveAbsJ jHome,v1000,fine,tVacuum;
   ENDPROC

   PROC prepareCell()
      Reset doVacuum;
      MoveAbsJ jHome,v1000,fine,tVacuum;
   ENDPROC

   PROC pickPart()
      MoveL Offs(pPick,0,0,80),v500,z10,tVacuum;
      MoveL pPick,v100,fine,tVacuum;
      Set doVacuum;
      WaitDI diPartPresent,1\\MaxTime:=2;
      MoveL Offs(pPick,0,0,80),v500,z10,tVacuum;
   ERROR
      IF ERRNO=ERR_WAIT_MAXTIME THEN
         TPWrite "No part: trying again";
         RETRY;
      ENDIF
   ENDPROC

   PROC placePart(robtarget place,PERS wobjdata tray\\switch gently)
      MoveJ Offs(place,0,0,80),v1000,z20,tVacuum\\WObj:=tray;
      IF Present(gently) THEN
         MoveL place,v50,fine,tVacuum\\WObj:=tray;
      ELSE
         MoveL place,v200,fine,tVacuum\\WObj:=tray;
      ENDIF
      Reset doVacuum;
      WaitTime 0.1;
   ENDPROC
ENDMODULE
`,
    CellData: `MODULE CellData(SYSMODULE,READONLY)
   TASK PERS wobjdata wTray:=[FALSE,TRUE,"",[[330,190,60],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
   CONST num nRows:=2;
   CONST num nColumns:=3;
ENDMODULE
`,
};

const signal = (name, type, value, label, device = "Cell_IO") => ({ name, type, value, simulated: false, device, label, category: "", min: 0, max: type[0] === "D" ? 1 : type[0] === "G" ? 255 : 100, writable: type.endsWith("O") });
export const signals = [
    signal("diStart", "DI", 0, "Start button"), signal("diPartPresent", "DI", 1, "Vacuum switch"), signal("diPartAtPick", "DI", 1, "Light barrier of the infeed"),
    signal("diDoorClosed", "DI", 1, "Safety door"), signal("doVacuum", "DO", 0, "Vacuum valve"), signal("doFeed", "DO", 1, "Infeed belt"),
    signal("doLampGreen", "DO", 1, "Lamp green"), signal("doLampRed", "DO", 0, "Lamp red"), signal("giOrder", "GI", 12, "Number of the order"),
    signal("goPlaced", "GO", 3, "Parts on the tray"), signal("aiWeight", "AI", 41.37, "Scale, g"), signal("aoBelt", "AO", 55.5, "Speed of the belt"),
    ...Array.from({ length: 40 }, (_, index) => signal(`diReserve${index + 1}`, "DI", 0, "", "Reserve")),
];

const datum = (name, type, kind, line, value, module = "MainModule") => ({ item: { path: `T_ROB1/${module}/${name}`, module, name, type, kind, dims: [], local: false, readOnly: kind === "const", line }, value });
export const data = [
    datum("partsPlaced", "num", "var", 3, "3"), datum("pPick", "robtarget", "pers", 4, "[[374,-180,240],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"),
    datum("tVacuum", "tooldata", "pers", 5, "[TRUE,[[0,0,95],[1,0,0,0]],[1,[0,0,40],[1,0,0,0],0,0,0]]"), datum("jHome", "jointtarget", "const", 6, "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"),
    datum("wTray", "wobjdata", "pers", 2, '[FALSE,TRUE,"",[[330,190,60],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]', "CellData"), datum("nRows", "num", "const", 3, "2", "CellData"), datum("nColumns", "num", "const", 4, "3", "CellData"),
];

const event = (number, code, type, title, task = "") => ({ number, code, type, time: `2026-11-25 T 14:03:${String(number).padStart(2, "0")}`, task, title });
export const events = [
    event(1, 10010, "state", "Motors OFF state"), event(2, 10011, "state", "Motors ON state"), event(3, 10150, "state", "Program started", "T_ROB1"),
    event(4, 50027, "error", "Joint Out of Range", "T_ROB1"), event(5, 10125, "state", "Program stopped", "T_ROB1"), event(6, 10002, "state", "Program pointer has been reset", "T_ROB1"),
    event(7, 80002, "warning", "Infeed is nearly empty", "T_ROB1"), event(8, 10151, "state", "Program started", "T_ROB1"),
];

export const zones = [
    { name: "wzOperator", kind: "box", active: true, inside: true, stops: true, signal: "", box: { from: [-350, -650, 0], to: [150, -430, 700] } },
    { name: "wzTray", kind: "cylinder", active: true, inside: true, stops: false, signal: "doLampGreen", cylinder: { centre: [330, 260, 0], radius: 130, height: 160 } },
];
