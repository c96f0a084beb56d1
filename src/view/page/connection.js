// The WebSocket to the program: reconnects by itself, separates frames from texts, matches answers with questions.

export class Connection {
  /// handlers: state(name, says), message(object), frame(header, blob)
  constructor(handlers) {
    this.handlers = handlers;
    this.failed = 0;      // in a row
    this.connects = 0;
    this.malformed = 0;
    this.last_ask = 0;
    this.asked = new Map();  // id: {resolve, reject}
    this.open();
  }
  get is_open() {
    return this.socket.readyState === WebSocket.OPEN;
  }
  open() {
    const address = new URL("socket" + location.search, location.href);
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    address.hash = "";
    this.handlers.state("connecting", this.failed ? "no connection: trying again" : "connecting");
    this.socket = new WebSocket(address);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = (event) => this.receive(event.data);
    this.socket.onclose = () => this.closed();
  }
  closed() {
    const pause_s = Math.min(0.5 * 2 ** this.failed++, 8);
    for (const { reject } of this.asked.values()) reject(new Error("the connection was lost"));
    this.asked.clear();
    this.handlers.state("closed", `no connection to the program: trying again in ${pause_s} s`);
    setTimeout(() => this.open(), 1000 * pause_s);
  }
  receive(data) {
    try {
      if (typeof data !== "string") return this.frame(data);
      const message = JSON.parse(data);
      if (message.type === "hello") {
        this.failed = 0;
        ++this.connects;
        this.handlers.state("open", "connected");
      }
      if (message.type !== "answer") return this.handlers.message(message);
      const question = this.asked.get(message.id);
      this.asked.delete(message.id);
      question?.resolve(message);
    } catch (error) {
      ++this.malformed;
      console.warn("a message could not be used:", error);
    }
  }
  frame(buffer) {
    const length = new DataView(buffer).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    const type = { jpeg: "image/jpeg", png: "image/png", exr: "image/x-exr" }[header.format];
    if (!type || !Number.isSafeInteger(header.id)) throw new Error("a frame of an unknown kind");
    this.handlers.frame(header, new Blob([new Uint8Array(buffer, 4 + length)], { type }));
  }
  send(message) {
    if (this.is_open) this.socket.send(JSON.stringify(message));
    return this.is_open;
  }
  /// Resolves to the answer, however long that takes: plots of large displays take minutes. Rejected when the connection is lost.
  ask(what, more = {}) {
    const id = ++this.last_ask;
    return new Promise((resolve, reject) => {
      if (!this.send({ type: "ask", id, what, ...more })) return reject(new Error("no connection to the program"));
      this.asked.set(id, { resolve, reject });
    });
  }
}
