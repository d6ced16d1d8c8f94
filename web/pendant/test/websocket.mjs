// A server side of WebSockets for tests: text frames only, no extensions.

import { createHash } from "node:crypto";

const magic = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"; // of RFC 6455

/** Answers an upgrade; `onText(text, send)` is called for each message. Returns a function that closes. */
export function accept(request, socket, onText, onClose = () => {}) {
    const key = createHash("sha1").update(request.headers["sec-websocket-key"] + magic).digest("base64");
    socket.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${key}\r\n\r\n`);
    let buffer = Buffer.alloc(0);
    const send = (text) => socket.writable && socket.write(frame(Buffer.from(text)));
    socket.on("data", (bytes) => {
        buffer = Buffer.concat([buffer, bytes]);
        for (let message = read(buffer); message; message = read(buffer)) {
            buffer = buffer.subarray(message.length);
            if (message.opcode === 8) socket.end();
            else if (message.opcode === 1) onText(message.text, send);
        }
    });
    socket.on("close", onClose);
    socket.on("error", () => {});
    return send;
}

function frame(payload) {
    const size = payload.length;
    const head = size < 126 ? Buffer.from([0x81, size]) : size < 65536 ? Buffer.from([0x81, 126, size >> 8, size & 255]) : Buffer.alloc(10);
    if (size >= 65536) {
        head[0] = 0x81;
        head[1] = 127;
        head.writeBigUInt64BE(BigInt(size), 2);
    }
    return Buffer.concat([head, payload]);
}

function read(buffer) {
    if (buffer.length < 6) return null;
    let size = buffer[1] & 127;
    let at = 2;
    if (size === 126) {
        size = buffer.readUInt16BE(2);
        at = 4;
    } else if (size === 127) {
        if (buffer.length < 14) return null;
        size = Number(buffer.readBigUInt64BE(2));
        at = 10;
    }
    if (buffer.length < at + 4 + size) return null;
    const mask = buffer.subarray(at, at + 4);
    const payload = Buffer.from(buffer.subarray(at + 4, at + 4 + size));
    for (let index = 0; index < size; index++) payload[index] ^= mask[index & 3];
    return { opcode: buffer[0] & 15, text: payload.toString(), length: at + 4 + size };
}
