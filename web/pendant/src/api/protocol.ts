// The objects of docs/pendant.md, which decides. Units: mm, degrees, seconds of virtual time, per cent.

/** x, y, z, q1 (real part), q2, q3, q4 */
export type Pose = number[];
export type Point = number[];

export interface Panel {
    motors: string;
    mode: "auto" | "manual" | "manualFull";
    speed: number;
    cycle: "forever" | "once";
    running: boolean;
    emergencyStop: boolean;
}

export interface Time {
    t: number;
    pace: number;
    running: boolean;
}

export interface Place {
    module: string;
    routine: string;
    line: number;
    column: number;
    endLine: number;
    endColumn: number;
    level: string;
}

export interface Task {
    name: string;
    type: string;
    active: boolean;
    state: string;
    unit: string;
    changes: number;
    pointer: Place | null;
    motion: Place | null;
    error: string;
}

export interface Frame {
    name: string;
    pose: Pose;
}

export interface Joint {
    axis: number;
    name: string;
    kind: "rotary" | "linear";
    lower: number;
    upper: number;
    maxSpeed: number;
}

export interface Solid {
    kind: "capsule" | "cylinder" | "box" | "rod";
    role?: string;
    from?: Point;
    to?: Point;
    radius?: number;
    pose?: Pose;
    size?: Point;
    toBody?: number;
}

export interface Body {
    name: string;
    parent: number;
    origin: Pose;
    axis: Point;
    motion: "fixed" | "rotary" | "linear" | "flange";
    constant: number;
    terms: [number, number][];
    solids: Solid[];
}

export interface Unit {
    name: string;
    model: string;
    task: string;
    base: Pose;
    tool: Frame;
    workObject: Frame;
    toolMass?: number;
    joints: Joint[];
    external: { number: number; unit: string; active: boolean }[];
    bodies: Body[];
    reach: number;
}

export interface Zone {
    name: string;
    kind: "box" | "cylinder" | "sphere" | "joints";
    active: boolean;
    inside: boolean;
    stops: boolean;
    signal: string;
    box?: { from: Point; to: Point };
    cylinder?: { centre: Point; radius: number; height: number };
    sphere?: { centre: Point; radius: number };
}

export interface Dialog {
    id: number;
    task: string;
    instruction: string;
    kind: "choice" | "number" | "text" | "list" | "message";
    header: string;
    lines: string[];
    icon: string;
    choices: string[];
    items: string[];
    /** What an entry begins with; of a list: the number of the item that OK alone takes. */
    initial: string;
    minimum?: number;
    maximum?: number;
    /** Of the keys + and - (UINumTune). */
    increment?: number;
    wholeNumbers?: boolean;
}

export interface Breakpoint {
    task: string;
    module: string;
    line: number;
    verified: boolean;
}

export interface State {
    panel: Panel;
    tasks: Task[];
    units: Unit[];
    zones: Zone[];
    dialogs: Dialog[];
    display: { lines: string[] };
    breakpoints: Breakpoint[];
    robotWare: string;
    name: string;
    time: Time;
}

export interface Signal {
    name: string;
    type: string;
    value: number;
    simulated: boolean;
    device: string;
    label: string;
    category: string;
    min: number;
    max: number;
    writable: boolean;
}

export interface DataItem {
    path: string;
    module: string;
    name: string;
    type: string;
    kind: "var" | "pers" | "const";
    dims: number[];
    local: boolean;
    readOnly: boolean;
    line: number;
}

export interface DataValue {
    path: string;
    value?: string;
    type?: string;
    dims?: number[];
    error?: string;
}

export interface LogEvent {
    number: number;
    code: number;
    type: "state" | "warning" | "error";
    time: string;
    task: string;
    title: string;
}

export interface LogDetails extends LogEvent {
    description: string;
    consequences: string;
    causes: string;
    actions: string;
    arguments: string[];
}

export interface ModuleInfo {
    name: string;
    kind: "program" | "system";
    lines: number;
    readOnly: boolean;
    path: string;
}

export interface Routine {
    module: string;
    name: string;
    kind: string;
    line: number;
    parameters: number;
}

/** index in State.units, joints, external axes, TCP in world, flange in base, TCP speed in mm/s, moving 0 or 1 */
export type UnitMotion = [number, number[], number[], Pose, Pose, number, number];

export interface Motion {
    t: number;
    units: UnitMotion[];
}

export interface UnitPosition {
    unit: string;
    joints: number[];
    external: number[];
    tcp: Pose;
    base: Pose;
    world: Pose;
    flange: Pose;
    config: number[];
}

/** Data of each notification. */
export interface Notifications {
    panel: Panel;
    task: Task;
    pointers: { task: string; pointer: Place | null; motion: Place | null };
    motion: Motion;
    event: LogEvent;
    display: { line?: string; clear?: boolean };
    dialog: { opened?: Dialog; closed?: number };
    signal: [string, number, 0 | 1][];
    data: [string, string | null][];
    frames: { unit: string; tool: Frame; workObject: Frame };
    breakpoints: { breakpoints: Breakpoint[] };
    zones: { zones: Zone[] };
    jog: { unit: string; moving: boolean; limit: string };
    time: Time;
    generation: Record<string, never>;
}
