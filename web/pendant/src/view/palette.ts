import { Color } from "three";
import { colour, isDark } from "../shell/theme";

/** Colours of the 3D view; the arm has its own, the rest comes from the design system. */
export function palette() {
    const dark = isDark();
    return {
        background: new Color(colour("view-background") || "#10151c"),
        grid: new Color(dark ? "#2a3440" : "#c3ccd6"),
        gridMain: new Color(dark ? "#3a4757" : "#a9b5c1"),
        arm: new Color(dark ? "#e8762c" : "#ec7a2f"),
        joint: new Color(dark ? "#5d6a79" : "#5a6675"),
        flange: new Color(dark ? "#aab5c2" : "#8a96a3"),
        tool: new Color(dark ? "#7fb4f5" : "#2f6fc4"),
        past: new Color(dark ? "#4aa3ff" : "#1668c7"),
        fast: new Color(dark ? "#ffb454" : "#d97706"),
        planned: new Color(dark ? "#7ee0a1" : "#16874a"),
        zoneInside: new Color(dark ? "#f0605d" : "#d13438"),
        zoneOutside: new Color(dark ? "#d9a441" : "#b7791f"),
        ghost: new Color(dark ? "#b48cf2" : "#7a4fd0"),
        axes: [new Color("#e5484d"), new Color("#3fae5a"), new Color("#3b82f6")] as const,
    };
}

export type Palette = ReturnType<typeof palette>;
