type Theme = "system" | "light" | "dark";

const key = "rapidc-theme";
const darkSystem = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<() => void>();

function stored(): Theme {
    try {
        const value = localStorage.getItem(key);
        return value === "light" || value === "dark" ? value : "system";
    } catch {
        return "system"; // storage is blocked
    }
}

let theme = stored();

export function currentTheme(): Theme {
    return theme;
}

export function isDark(): boolean {
    return theme === "system" ? darkSystem.matches : theme === "dark";
}

/** Canvases draw again with the colours of the other theme. */
export function onThemeChange(listener: () => void): void {
    listeners.add(listener);
}

function apply(): void {
    document.documentElement.dataset.theme = isDark() ? "dark" : "light";
    for (const listener of listeners) listener();
}

export function setTheme(value: Theme): void {
    theme = value;
    try {
        localStorage.setItem(key, value);
    } catch {
        // it holds until the page is closed
    }
    apply();
}

export function startTheme(): void {
    darkSystem.addEventListener("change", apply);
    apply();
}

/** A colour of the design system, for canvases. */
export function colour(name: string): string {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
