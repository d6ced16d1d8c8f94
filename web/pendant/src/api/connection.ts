import type { Notifications } from "./protocol";

/** An answer with `error`. */
export class RequestError extends Error {
    constructor(
        readonly code: string,
        message: string,
        readonly remedy = "",
    ) {
        super(message);
    }
}

type Handler<K extends keyof Notifications> = (data: Notifications[K]) => void;
export type Status = "connecting" | "open" | "login" | "closed" | "restarting";

interface Waiting {
    resolve: (result: unknown) => void;
    reject: (error: Error) => void;
}

const firstRetry = 400; // ms
const longestRetry = 5000; // ms
const serviceRestart = 1012; // close code: the controller restarts

/** The WebSocket of the page: requests with promises, notifications by name; opens itself again after a close. */
export class Connection {
    private socket: WebSocket | null = null;
    private next = 1;
    private retry = firstRetry;
    private password: string | undefined;
    private readonly waiting = new Map<number, Waiting>();
    private readonly handlers = new Map<string, Set<(data: never) => void>>();
    onStatus: (status: Status) => void = () => {};
    /** Called after each successful hello: all that was known before is gone. */
    onReady: (hello: { product: string; robotWare: string }) => void = () => {};

    constructor(private readonly address: string) {}

    open(): void {
        this.onStatus("connecting");
        const socket = new WebSocket(this.address);
        this.socket = socket;
        socket.onopen = () => void this.hello();
        socket.onmessage = (message) => this.receive(String(message.data));
        socket.onclose = ({ code }) => this.closed(code === serviceRestart);
    }

    on<K extends keyof Notifications>(name: K, handler: Handler<K>): void {
        const known = this.handlers.get(name) ?? new Set();
        known.add(handler as (data: never) => void);
        this.handlers.set(name, known);
    }

    request<T = Record<string, never>>(method: string, params: object = {}): Promise<T> {
        const socket = this.socket;
        if (!socket || socket.readyState !== WebSocket.OPEN) {
            return Promise.reject(new RequestError("closed", "There is no connection to the controller"));
        }
        const id = this.next++;
        return new Promise<T>((resolve, reject) => {
            this.waiting.set(id, { resolve: resolve as (result: unknown) => void, reject });
            socket.send(JSON.stringify({ id, method, params }));
        });
    }

    /** Continues after status "login". */
    login(password: string): Promise<void> {
        this.password = password;
        return this.hello();
    }

    private async hello(): Promise<void> {
        try {
            const params = this.password === undefined ? {} : { password: this.password };
            const hello = await this.request<{ product: string; robotWare: string }>("hello", params);
            this.retry = firstRetry;
            this.onStatus("open");
            this.onReady(hello);
        } catch (error) {
            if (error instanceof RequestError && error.code === "login") this.onStatus("login");
        }
    }

    private receive(text: string): void {
        const message = JSON.parse(text) as {
            id?: number;
            result?: unknown;
            error?: { code: string; message: string; remedy?: string };
            event?: string;
            data?: unknown;
        };
        if (message.event !== undefined) {
            for (const handler of this.handlers.get(message.event) ?? []) handler(message.data as never);
            return;
        }
        const waiting = this.waiting.get(message.id ?? -1);
        if (!waiting) return;
        this.waiting.delete(message.id ?? -1);
        const { error } = message;
        if (error) waiting.reject(new RequestError(error.code, error.message, error.remedy ?? ""));
        else waiting.resolve(message.result ?? {});
    }

    private closed(restarts: boolean): void {
        this.socket = null;
        for (const waiting of this.waiting.values()) {
            waiting.reject(new RequestError("closed", restarts ? "The controller restarts" : "The connection to the controller was lost"));
        }
        this.waiting.clear();
        this.onStatus(restarts ? "restarting" : "closed");
        setTimeout(() => this.open(), this.retry);
        this.retry = Math.min(this.retry * 2, longestRetry);
    }
}
