// Skips rounds of a loop that wait: a round that ends in the state in which it began, and did nothing, does the same until the time that it
// reads, a pin or an interrupt changes. The cycles of the rounds that are skipped count; only the host is spared. Also: memory without detours.
'use strict';

const RAM = 0x20000000, TIMER = 0x40054000, PINS = 0xd0000000;
const TICK = 1000; // ns: what the timer tells changes then
const TIMES = new Set([0x08, 0x0c, 0x24, 0x28].map((at) => TIMER + at)); // of the timer: the time, latched and as it is
const LEVELS = new Set([0x04, 0x10, 0x20].map((at) => PINS + at)); // of the pins: inputs, outputs, directions
const OTHERS = 8; // jumps back to other places after which one of them is taken as the beginning of the loop

/** Returns {jumped(nanos, until), disturb()}: nanoseconds to skip after a jump back; something happened from outside. */
exports.rounds = function rounds(chip) {
  const { core, flash, sram } = chip;
  const flash16 = new Uint16Array(flash.buffer), flash32 = new Uint32Array(flash.buffer);
  const ram8 = sram, ram16 = new Uint16Array(sram.buffer), ram32 = new Uint32Array(sram.buffer), size = sram.length;
  let did = true, timed = false; // since the round began: something that is not undone; the time was read

  core.readUint16 = (address) => address >>> 28 === 1 ? flash16[(address & 0xffffff) >> 1] : other(address, chip.readUint16(address));
  core.readUint8 = (address) => {
    const at = address - RAM >>> 0;
    return at < size ? ram8[at] : other(address, chip.readUint8(address));
  };
  core.readUint32 = (address) => {
    const at = address - RAM >>> 0;
    if (!(address & 3)) {
      if (at < size) return ram32[at >> 2];
      if (address >>> 28 === 1) return flash32[(address & 0xffffff) >> 2];
    }
    return other(address, chip.readUint32(address));
  };
  function other(address, value) {
    address >>>= 0;
    if (TIMES.has(address)) timed = true;
    else if (address > 0x20ffffff && !LEVELS.has(address)) did = true;
    return value;
  }
  core.writeUint32 = (address, value) => {
    const at = address - RAM >>> 0;
    if (at >= size || at & 3) {
      did = true;
      chip.writeUint32(address, value);
    } else if (ram32[at >> 2] !== value >>> 0) {
      did = true;
      ram32[at >> 2] = value;
    }
  };
  core.writeUint16 = (address, value) => {
    const at = address - RAM >>> 0;
    if (at >= size || at & 1) {
      did = true;
      chip.writeUint16(address, value);
    } else if (ram16[at >> 1] !== (value & 0xffff)) {
      did = true;
      ram16[at >> 1] = value;
    }
  };
  core.writeUint8 = (address, value) => {
    const at = address - RAM >>> 0;
    if (at >= size) {
      did = true;
      chip.writeUint8(address, value);
    } else if (ram8[at] !== (value & 0xff)) {
      did = true;
      ram8[at] = value;
    }
  };

  const begun = new Uint32Array(core.registers.length), PC = 15;
  let flags = 0, since = 0, others = 0;
  const now = () => +core.N << 3 | +core.Z << 2 | +core.C << 1 | +core.V | +core.PM << 4 | core.IPSR << 5;
  function begin(nanos) {
    begun.set(core.registers);
    flags = now();
    since = nanos;
    did = timed = false;
    others = 0;
  }

  return {
    disturb() { did = true; },
    /** After a jump back at a time: the nanoseconds of whole rounds until the next thing that may happen by itself. */
    jumped(nanos, until) {
      const { registers } = core;
      if (registers[PC] !== begun[PC]) {
        if (++others > OTHERS) begin(nanos);
        return 0;
      }
      let same = !did;
      for (let i = 0; same && i < PC; i++) same = registers[i] === begun[i];
      same = same && flags === now();
      const round = nanos - since, end = timed ? Math.min(until, (Math.floor(since / TICK) + 1) * TICK) : until; // it read that time
      begin(nanos);
      if (!same) return 0;
      const skipped = Math.max(0, Math.floor((end - nanos) / round)) * round;
      since += skipped;
      return skipped;
    },
  };
};
