// What rp2040js 1.4.1 has otherwise than the chip, and programs notice. Facts: RP2040 data sheet; each was measured with and without its repair.
'use strict';

const PADS_AFTER_RESET = 0x56; // input on, drive of 4 mA, pull-down; rp2040js: input off
const FIRST_ALARM = 0x10, LAST_ALARM = 0x1c;
const JUMP = 0, MOVE = 5, IF_X = 2, IF_Y = 4, IF_OTHER = 5, IF_PIN = 6; // PIO: operations, conditions of jumps
const JOINED = 0xc0000000; // the two queues of a state machine as one
const SHIFT_CONTROL = 8;

/** Inputs are on after a reset. */
exports.pads = function pads(chip) {
  for (const gpio of chip.gpio) gpio.padValue = PADS_AFTER_RESET;
};

/** An alarm comes on its microsecond, not up to one early. */
exports.alarms = function alarms(chip) {
  const { clock } = chip, timer = chip.peripherals[0x40054], write = timer.writeUint32.bind(timer);
  timer.writeUint32 = (offset, value) => {
    write(offset, value);
    if (offset < FIRST_ALARM || offset > LAST_ALARM) return;
    const us = Math.floor(clock.nanos / 1000), left = ((value - us) >>> 0) * 1000 - (clock.nanos - us * 1000);
    timer.alarms[(offset - FIRST_ALARM) / 4].clockAlarm.schedule(Math.max(0, left));
  };
};

/** A serial line takes the time of its bits; `flags` tells how full its queue is. Returns (line number, byte) -> when its start bit begins. */
exports.serialTimes = function serialTimes(chip) {
  const DEPTH = 32, EMPTY = 0x80, FULL = 0x20, BUSY = 0x08;
  const free = chip.uart.map(() => 0);
  const frame = (uart) => 10e9 / Math.max(uart.baudRate, 300);
  chip.uart.forEach((uart, line) => {
    const plain = Object.getOwnPropertyDescriptor(Object.getPrototypeOf(uart), 'flags').get;
    Object.defineProperty(uart, 'flags', {
      get() {
        const waiting = Math.max(0, (free[line] - chip.clock.nanos) / frame(uart));
        return plain.call(uart) & ~(EMPTY | FULL | BUSY) | (waiting > DEPTH ? FULL : 0) | (waiting <= 0 ? EMPTY : BUSY);
      },
    });
  });
  return (line) => {
    const from = Math.max(free[line], chip.clock.nanos);
    free[line] = from + frame(chip.uart[line]);
    return from;
  };
};

/**
 * PIO in simulated time and with its clock divider (rp2040js runs it from setTimeout, without).
 * Returns {on(), sync(to), now()}: whether a machine runs, run them all up to a time, and the time of the instruction that is under way or null.
 */
exports.pio = function pio(chip) {
  const { clock } = chip;
  let cycle = 1e9 / chip.clkSys, underWay = null, running = false;
  chip.addClockListener((hertz) => { cycle = 1e9 / hertz; });

  function step(block, machine, to) {
    const turn = cycle * ((machine.clockDivInt || 65536) + machine.clockDivFrac / 256);
    const word = block.instructions[machine.pc], operation = word >>> 13, condition = word >>> 5 & 7;
    const counts = operation === JUMP && (condition === IF_X || condition === IF_Y);
    if (counts && (word & 31) === machine.pc && machine.before === word) { // it waits by counting down: skip what lies before `to`
      const delay = word >> 8 & (1 << 5 - machine.sidesetCount) - 1, cost = turn * (1 + delay);
      const turns = Math.min(condition === IF_X ? machine.x : machine.y, Math.floor((to - machine.next) / cost));
      if (turns > 0) {
        if (condition === IF_X) machine.x = (machine.x - turns) >>> 0;
        else machine.y = (machine.y - turns) >>> 0;
        machine.next += turns * cost;
        return;
      }
    }
    if (operation === JUMP && condition === IF_OTHER) { // a round that only counts y down until it meets x or 0: skip whole rounds
      const last = machine.round;
      const same = last && last.pc === machine.pc && last.x === machine.x && last.y === machine.y + 1 && last.pins === block.pinValues;
      if (same && machine.y !== machine.x && !machine.changed) {
        const cost = machine.next - last.next, left = (machine.y > machine.x ? machine.y - machine.x : machine.y) - 1;
        const rounds = Math.min(left, Math.floor((to - machine.next) / cost));
        if (rounds > 0) {
          machine.y -= rounds;
          machine.next += rounds * cost;
        }
      }
      machine.round = { pc: machine.pc, x: machine.x, y: machine.y, pins: block.pinValues, next: machine.next };
      machine.changed = false;
    } else if (operation !== JUMP && operation !== MOVE || operation === JUMP && condition === IF_PIN) machine.changed = true;
    machine.before = word;
    const cycles = machine.cycles;
    underWay = machine.next;
    machine.step();
    block.checkChangedPins();
    underWay = null;
    machine.next += Math.max(1, machine.cycles - cycles) * turn;
  }

  function sync(to = clock.nanos) {
    for (const block of chip.pio)
      for (;;) {
        let first = null;
        for (const machine of block.machines)
          if (machine.enabled && !machine.waiting && (first === null || machine.next < first.next)) first = machine;
        if (first === null || first.next > to) break;
        step(block, first, to);
      }
  }

  for (const block of chip.pio) {
    block.run = () => {};
    for (const machine of block.machines) {
      machine.next = 0;
      machine.clkDivRestart = () => {};
      const checkWait = machine.checkWait.bind(machine), write = machine.writeUint32.bind(machine);
      machine.checkWait = () => {
        const waited = machine.waiting;
        checkWait();
        if (waited && !machine.waiting) machine.next = Math.max(machine.next, underWay ?? clock.nanos);
      };
      machine.writeUint32 = (offset, value) => {
        const before = machine.shiftCtrl;
        write(offset, value);
        if (offset !== SHIFT_CONTROL || !((before ^ machine.shiftCtrl) & JOINED)) return;
        for (const queue of [machine.txFIFO, machine.rxFIFO]) while (!queue.empty) queue.pull();
      };
    }
    const write = block.writeUint32.bind(block), read = block.readUint32.bind(block);
    block.writeUint32 = (offset, value) => {
      if (running) sync();
      const before = block.machines.map((machine) => machine.enabled);
      write(offset, value);
      block.machines.forEach((machine, i) => { if (machine.enabled && !before[i]) machine.next = clock.nanos; });
      block.checkChangedPins();
      running = chip.pio.some((each) => each.machines.some((machine) => machine.enabled));
    };
    block.readUint32 = (offset) => {
      if (running) sync();
      return read(offset);
    };
  }
  return { on: () => running, sync, now: () => underWay };
};
