import type { Model } from "../api/model";
import type { Dialog } from "../api/protocol";
import { button } from "../ui/controls";
import { h, replaceChildren, uniqueId } from "../ui/dom";
import { icon, type IconName } from "../ui/icons";
import { attempt } from "../ui/notices";

/** "1 to 40, whole numbers", "" when every number is taken. */
function limitsOf({ minimum, maximum, wholeNumbers }: Dialog): string {
    const least = minimum !== undefined && Math.abs(minimum) < 1e30 ? minimum : undefined;
    const most = maximum !== undefined && Math.abs(maximum) < 1e30 ? maximum : undefined;
    const range = least !== undefined && most !== undefined ? `${least} to ${most}` : least !== undefined ? `From ${least}` : most !== undefined ? `Up to ${most}` : "";
    if (!wholeNumbers) return range;
    return range ? `${range}, whole numbers` : "Whole numbers";
}

const icons: Record<string, IconName> = { warning: "events", error: "events", question: "display" };

/** Questions of the program (UIMsgBox, TPReadFK ...) as a card over the page; the rest stays usable, as on a real pendant. */
export class DialogLayer {
    readonly element = h("div", { class: "dialogs", attrs: { "aria-live": "assertive" } });
    private readonly cards = new Map<number, HTMLElement>();

    constructor(private readonly model: Model) {
        model.on("all", (state) => this.show(state.dialogs));
        model.on("dialogs", (dialogs) => this.show(dialogs));
    }

    private show(dialogs: Dialog[]): void {
        for (const [id, card] of this.cards) {
            if (dialogs.some((dialog) => dialog.id === id)) continue;
            card.remove();
            this.cards.delete(id);
        }
        for (const dialog of dialogs) {
            if (this.cards.has(dialog.id)) continue;
            const card = this.card(dialog);
            this.cards.set(dialog.id, card);
            this.element.append(card);
            const first = card.querySelector<HTMLElement>('[aria-current="true"]') ?? card.querySelector<HTMLElement>("input, .list-item, .dialog-buttons button");
            first?.focus();
        }
    }

    private card(dialog: Dialog): HTMLElement {
        const title = uniqueId("dialog");
        const body = h("div", { class: "dialog-body" }, ...dialog.lines.map((text) => h("p", { text })));
        const buttons = h("div", { class: "dialog-buttons" });
        this.fill(dialog, body, buttons);
        const kind = dialog.icon.toLowerCase();
        return h(
            "section",
            { class: `dialog dialog-${kind}`, attrs: { role: "dialog", "aria-labelledby": title } },
            h("header", { class: "dialog-head" }, icon(icons[kind] ?? "display"), h("h2", { text: dialog.header || dialog.instruction, attrs: { id: title } }), h("span", { class: "muted", text: dialog.task })),
            body,
            buttons,
        );
    }

    private fill(dialog: Dialog, body: HTMLElement, buttons: HTMLElement): void {
        const choices = dialog.choices.map((label, index) => ({ label, choice: index + 1 })).filter(({ label }) => label !== "");
        const chosen = (): object => {
            const items = [...body.querySelectorAll(".list-item")];
            const item = items.findIndex((each) => each.getAttribute("aria-current") === "true") + 1;
            return item > 0 ? { item } : {};
        };
        const choose = choices.map(({ label, choice }, index) =>
            button({ label, class: index === 0 ? "primary" : "", onClick: () => this.answer(dialog, { choice, ...chosen() }) }),
        );
        if (dialog.kind === "number" || dialog.kind === "text") {
            this.fillInput(dialog, body, buttons);
            return;
        }
        if (dialog.kind === "list") {
            const standard = Number(dialog.initial);
            // With buttons the item is only chosen, and a button answers, which may be any of them; without buttons the item answers.
            const pick = (index: number): void => {
                if (choose.length === 0) this.answer(dialog, { item: index + 1 });
                else items.forEach((each, place) => (place === index ? each.setAttribute("aria-current", "true") : each.removeAttribute("aria-current")));
            };
            const items: HTMLElement[] = dialog.items.map((text, index) =>
                h("button", {
                    class: "list-item",
                    text,
                    attrs: { type: "button", "aria-current": index + 1 === standard ? "true" : undefined },
                    on: { click: () => pick(index) },
                }),
            );
            body.append(h("div", { class: "dialog-list" }, ...items));
        }
        if (choose.length > 0) replaceChildren(buttons, ...choose);
        else if (dialog.kind === "message") buttons.hidden = true;
    }

    private fillInput(dialog: Dialog, body: HTMLElement, buttons: HTMLElement): void {
        const numeric = dialog.kind === "number";
        const input = h("input", {
            class: "input large",
            attrs: {
                type: numeric ? "number" : "text",
                inputmode: numeric ? "decimal" : "text",
                step: numeric ? (dialog.wholeNumbers ? 1 : (dialog.increment ?? "any")) : undefined,
                min: dialog.minimum,
                max: dialog.maximum,
                maxlength: numeric ? undefined : 80,
                "aria-label": dialog.lines[dialog.lines.length - 1] ?? dialog.header,
            },
        });
        input.value = dialog.initial;
        const problem = h("p", { class: "dialog-problem", attrs: { role: "alert", hidden: true } });
        input.addEventListener("input", () => (problem.hidden = true));
        const send = (): void => {
            const { valueMissing, badInput, rangeUnderflow, rangeOverflow } = input.validity;
            const wrong = numeric && (input.value === "" || valueMissing || badInput) ? "Enter a number." : rangeUnderflow ? `The smallest value is ${dialog.minimum}.` : rangeOverflow ? `The largest value is ${dialog.maximum}.` : "";
            const isPart = numeric && dialog.wholeNumbers && !Number.isInteger(Number(input.value));
            if (wrong || isPart) {
                problem.textContent = wrong || "A whole number is expected.";
                problem.hidden = false;
                input.focus();
                return;
            }
            this.answer(dialog, numeric ? { number: Number(input.value) } : { text: input.value });
        };
        input.addEventListener("keydown", (event) => event.key === "Enter" && send());
        body.append(input, problem);
        const limits = numeric ? limitsOf(dialog) : "";
        if (limits) body.append(h("p", { class: "muted", text: limits }));
        queueMicrotask(() => input.select());
        buttons.append(button({ label: "OK", class: "primary", onClick: send }));
    }

    private answer(dialog: Dialog, answer: object): void {
        attempt(() => this.model.connection.request("dialogs.answer", { id: dialog.id, ...answer }));
    }
}
