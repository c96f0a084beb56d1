// When to send the wanted state: only the newest, at most two unanswered, and once more when nothing moves.

const at_once = 2;        // messages without a frame yet
const patience_ms = 100;  // after this one more is sent anyway
const rest_ms = 80;

export class Pacing {
  /// say(id, moving) sends; returns false if there is no connection. rest() is called after a message without `moving`.
  constructor(say_wish, rest) {
    this.say = say_wish;
    this.rest = rest;
    this.id = 0;
    this.answered = 0;
    this.sent = new Map();  // id: {at, event, moving}: those whose frame has not been drawn
    this.dirty = false;
    this.waiting = false;
  }
  /// Asks for a new frame; to be called when something changed at that time; `moving`: more is about to come.
  wish(moving, time) {
    this.event = time;
    this.dirty = true;
    clearTimeout(this.timer);
    if (!moving) return this.settle();
    this.timer = setTimeout(() => this.settle(), rest_ms);
    this.soon();
  }
  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.dirty) return;
      const open = [...this.sent.entries()].filter(([id]) => id > this.answered);
      if (open.length < at_once || performance.now() - open.at(-1)[1].at > patience_ms) this.send(true);
      else this.soon();
    });
  }
  /// The pointer is released, or nothing has moved for a while: asks for the sharp picture.
  settle() {
    clearTimeout(this.timer);
    if (this.dirty || this.said_moving) this.send(false);
    this.rest();
  }
  send(moving) {
    this.dirty = false;
    const now = performance.now();
    if (!this.say(this.id + 1, moving)) return;
    this.said_moving = moving;
    this.sent.set(++this.id, { at: now, event: this.event ?? now, moving });
    for (const id of this.sent.keys()) if (id < this.id - 50) this.sent.delete(id);
  }
  /// Notes that a frame or a refusal came for that id.
  answer(id) {
    this.answered = Math.max(this.answered, id);
  }
  /// The record of the message with that id, when its frame has been drawn; older ones are forgotten.
  drawn(id) {
    const known = this.sent.get(id);
    for (const older of this.sent.keys()) if (older < id) this.sent.delete(older);
    return known;
  }
  /// Starts again for a new connection, which has no state yet.
  again() {
    this.answered = this.id;
    this.dirty = true;
    this.settle();
  }
}
