// Icons of our own, on a grid of 24, drawn with strokes in the colour of the text.

const shapes = {
    play: "M7 4.500v15l12-7.500z",
    stop: "M6 6h12v12H6z",
    stepForward: "M5 5v14l9-7zM18 5v14",
    stepBack: "M19 5v14l-9-7zM6 5v14",
    stepInto: "M12 3v11M7 9.500l5 5 5-5M5 20h14",
    toMain: "M4 5h9M4 12h5M4 19h9M21 12h-9M15.500 8.500 12 12l3.500 3.500",
    motors: "M12 3v8M7 6.200a8 8 0 1 0 10 0",
    program: "M8 7l-5 5 5 5M16 7l5 5-5 5M13.500 5l-3 14",
    events: "M12 4 2.500 20h19zM12 10v4.500M12 17.300v.2",
    signals: "M3 16h4V8h5v8h5V8h4",
    data: "M4 5h16v14H4zM4 10h16M4 14.500h16M10 10v9",
    display: "M3 5h18v12H3zM8 21h8M7 9h7M7 13h4",
    jog: "M12 3v18M3 12h18M9.500 5.500 12 3l2.500 2.500M9.500 18.500 12 21l2.500-2.500M5.500 9.500 3 12l2.500 2.500M18.500 9.500 21 12l-2.500 2.500",
    recording: "M3 17l5-6 4 3 5-8 4 5M3 21h18",
    files: "M3 6h6l2 2.500h10V19H3z",
    sun: "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.400 1.400M17.600 17.600 19 19M5 19l1.400-1.400M17.600 6.400 19 5",
    moon: "M20 14.500A8.500 8.500 0 0 1 9.500 4a8.500 8.500 0 1 0 10.500 10.500z",
    auto: "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",
    close: "M6 6l12 12M18 6 6 18",
    search: "M10.500 4a6.500 6.500 0 1 0 0 13 6.500 6.500 0 0 0 0-13zM15.300 15.300 21 21",
    edit: "M4 20h4L19 9l-4-4L4 16zM13.500 6.500l4 4",
    save: "M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6",
    check: "M4 12.500 10 18 20 6",
    undo: "M4 9h11a5 5 0 0 1 0 10H8M8 5 4 9l4 4",
    refresh: "M20 11a8 8 0 1 0-2.300 6.300M20 5v6h-6",
    plus: "M12 5v14M5 12h14",
    minus: "M5 12h14",
    target: "M12 5a7 7 0 1 0 0 14 7 7 0 0 0 0-14zM12 1.500v5M12 17.500v5M1.500 12h5M17.500 12h5",
    follow: "M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4",
    home: "M4 11 12 4l8 7M6 10v10h12V10",
    layers: "M12 3 2.500 8 12 13l9.500-5zM2.500 12.500 12 17.500l9.500-5M2.500 16.500 12 21.500l9.500-5",
    expand: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
    pin: "M12 21v-7M8 14h8l-1.500-4V4h-5v6z",
    upload: "M12 16V4M7.500 8.500 12 4l4.500 4.500M4 16v4h16v-4",
    archive: "M3 4h18v5H3zM5 9v11h14V9M10 13h4",
    trash: "M4 7h16M9 7V4h6v3M6 7l1 13h10l1-13",
    folder: "M3 6h6l2 2.500h10V19H3z",
    file: "M6 3h8l5 5v13H6zM14 3v5h5",
    eye: "M2 12s3.500-7 10-7 10 7 10 7-3.500 7-10 7S2 12 2 12zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
    clear: "M6 6l12 12M18 6 6 18",
    live: "M12 10a2 2 0 1 0 0 4 2 2 0 0 0 0-4zM7 7a7 7 0 0 0 0 10M17 7a7 7 0 0 1 0 10",
    chevron: "M9 5l7 7-7 7",
    unlock: "M6 11h12v9H6zM9 11V7.500a3 3 0 0 1 5.800-1",
    wifi: "M12 19v.2M8.500 15.500a5 5 0 0 1 7 0M5 12a10 10 0 0 1 14 0M2 8.500a14.500 14.500 0 0 1 20 0",
} as const;

export type IconName = keyof typeof shapes;

const space = "http://www.w3.org/2000/svg";
const filled = new Set<IconName>(["play", "stop"]);

export function icon(name: IconName, extraClass = ""): SVGSVGElement {
    const svg = document.createElementNS(space, "svg");
    svg.setAttribute("viewBox", "0 0 24 24");
    svg.setAttribute("class", `icon ${filled.has(name) ? "icon-filled" : ""} ${extraClass}`);
    svg.setAttribute("aria-hidden", "true");
    const path = document.createElementNS(space, "path");
    path.setAttribute("d", shapes[name]);
    svg.append(path);
    return svg;
}
