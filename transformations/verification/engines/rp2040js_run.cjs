// Runs a program on rp2040js (npm, MIT), for the engine `rp2040js`. Talks with it in lines of JSON, one question and one answer at a time:
// questions go to standard output, answers come from standard input. The first line that arrives is the job.
//   question: {t, log: [["p", t, label, level] | ["w", t, label, hz, duty] | ["u", t, byte] ...], ask: why, ...}   t in nanoseconds
//   answer:   [["set", label, 0|1|null] | ["join"|"part", label, label] | ["adc", channel, volts] | ["send", [bytes]] | ["wake", t] ...]
'use strict';
const fs = require('fs');
const { RP2040, USBCDC } = require('rp2040js');
const repairs = require('./rp2040js_repairs.cjs');
const rom = require('./rp2040js_rom.cjs');
const { rounds } = require('./rp2040js_rounds.cjs');
const { bus: ownBus } = require('./rp2040js_bus.cjs');

const FLASH = 0x10000000, RAM = 0x20000000, RAM_END = 0x20042000, TABLES = [FLASH + 0x100, FLASH, RAM]; // behind the second boot stage; without; in RAM
const LOADED = 1; // a segment of an ELF file
const SERIAL = 2, WAVE = 4; // functions of a pin
const LEVELS = [0, 1, 'z', 'p', 'z', 'z']; // low, high, input: free, pulled up, pulled down, kept
const PIO_STEP = 20000, PIO_SLEEP = 50000; // ns that PIO may lag behind
const NOWHERE = 256; // accesses where no memory is that a right program does not make: a fault on the chip
const LONGEST_LOG = 20000;
const STEPS = 4095; // of the converter

const input = Buffer.alloc(1 << 16);
let rest = '';
function readLine() {
  for (;;) {
    const end = rest.indexOf('\n');
    if (end >= 0) {
      const line = rest.slice(0, end);
      rest = rest.slice(end + 1);
      return JSON.parse(line);
    }
    let count = 0;
    try {
      count = fs.readSync(0, input, 0, input.length, null);
    } catch (error) {
      if (error.code === 'EAGAIN') continue;
      throw error;
    }
    if (count === 0) process.exit(0); // who asked is gone
    rest += input.toString('latin1', 0, count);
  }
}
function write(value) {
  const data = Buffer.from(JSON.stringify(value) + '\n', 'latin1');
  for (let at = 0; at < data.length;) at += fs.writeSync(1, data, at);
}

const job = readLine();
const chip = new RP2040(), { clock, core } = chip;
let crashed = '', nowhere = 0;
const crash = (why) => { crashed = crashed || why; };
function note(part, message) {
  if (/invalid memory|undefined address/.test(message) && ++nowhere === NOWHERE) crash('it reads or writes where no memory is');
}
chip.logger = { debug() {}, info() {}, warn: note, error: note };

// ---- the program: segments at their load addresses, then what the second boot stage ends with
const elf = fs.readFileSync(job.elf);
for (let i = 0, header = elf.readUInt32LE(28); i < elf.readUInt16LE(44); i++, header += 32) {
  const [type, from, , to, size] = [0, 4, 8, 12, 16].map((offset) => elf.readUInt32LE(header + offset));
  const memory = to >>> 28 === 1 ? chip.flash : to >>> 24 === 0x20 ? chip.sram : null;
  if (type === LOADED && size && memory !== null) memory.set(elf.subarray(from, from + size), to & 0xffffff);
}
function isTable(at) {
  const stack = chip.readUint32(at) >>> 0, start = chip.readUint32(at + 4) >>> 0;
  return stack > RAM && stack <= RAM_END && !(stack & 3) && (start & 1) === 1 && (start >>> 28 === 1 || start >>> 24 === 0x20);
}
const table = TABLES.find(isTable);
if (table === undefined) throw new Error('the program has no table of vectors');
core.VTOR = table;
core.SP = chip.readUint32(table);
core.PC = chip.readUint32(table + 4) & ~1;

const inRom = rom.install(chip, crash);
chip.onBreak = (number) => { if (!inRom(number)) crash('it stops itself, as after a fault'); };
repairs.pads(chip);
repairs.alarms(chip);
const sendAt = repairs.serialTimes(chip), pio = repairs.pio(chip);
chip.peripherals[0x40058].onWatchdogTrigger = () => crash('its watchdog resets it');

let log = [];
let wake = Infinity;
let until = 0; // instructions are run without a look at anything else up to here
const now = () => Math.round(pio.now() ?? clock.nanos);
const after = (nanos, action) => clock.createAlarm(action).schedule(Math.max(0, nanos));
function ask(question) {
  write({ t: now(), log, ...question });
  log = [];
  until = 0; // there may be something to do earlier than was known
  for (const [what, a, b] of readLine()) {
    if (what === 'set') {
      pins[a].outside = b;
      settle(pins[a]);
    } else if (what === 'join' || what === 'part') {
      for (const [end, other] of [[pins[a], pins[b]], [pins[b], pins[a]]]) {
        end.contact = what === 'join' ? other : null;
        settle(end);
      }
    } else if (what === 'adc') chip.adc.channelValues[a] = Math.max(0, Math.min(STEPS, Math.floor(b / job.volts * (STEPS + 1))));
    else if (what === 'send') {
      waiting.push(...a);
      deliver();
    } else if (what === 'wake') wake = a === null ? Infinity : a;
    else answer = a;
  }
}
let answer = null;
function tell(entry) {
  log.push(entry);
  if (log.length > LONGEST_LOG) ask({ ask: 'log' });
}

// ---- pins. What is read at an input: what the program drives there, at the other end of a contact, what drives it from outside, its pull-up.
// rp2040js lets neither outputs nor pull-ups reach the input, and latches an edge whenever a level is set.
const reactive = new Set(job.reactive), brief = new Set(job.brief), told = new Set();
const pins = {}, atNumber = [];
for (const [label, number] of Object.entries(job.pins)) {
  const pin = { label, gpio: chip.gpio[+number], level: 'z', outside: null, contact: null, read: false, wave: '0,0', sends: 1 };
  pins[label] = pin;
  atNumber[+number] = pin;
  pin.gpio.addListener(() => changed(pin));
  const check = pin.gpio.checkForUpdates.bind(pin.gpio);
  let before = pin.gpio.functionSelect;
  pin.gpio.checkForUpdates = () => {
    check();
    if (pin.gpio.functionSelect === before) return;
    before = pin.gpio.functionSelect;
    changed(pin);
    waveAt(pin);
  };
}
function settle(pin) {
  const far = pin.contact === null ? 'z' : pin.contact.level;
  let level = pin.level;
  if (level === 'z' || level === 'p') level = far === 0 || far === 1 ? far : pin.outside ?? (level === 'p' || far === 'p' ? 1 : 0);
  const read = level === 1;
  if (read === pin.read) return;
  pin.read = read;
  pin.gpio.setInputValue(read);
  heard(pin);
}
function changed(pin) {
  const { functionSelect } = pin.gpio;
  if (functionSelect === WAVE) return; // told as a wave
  drives(pin, functionSelect === SERIAL && sender(pin) !== null ? pin.sends : LEVELS[pin.gpio.value]);
}
function drives(pin, level) {
  if (level === pin.level) return;
  const before = pin.level;
  pin.level = level;
  settle(pin);
  if (ownLines !== null) ownLines(pin, before);
  if (pin.contact !== null) settle(pin.contact);
  if (brief.has(pin.label)) {
    if (told.has(pin.label + level)) return;
    told.add(pin.label + level);
  }
  tell(['p', now(), pin.label, level]);
  if (reactive.has(pin.label)) ask({ ask: 'pins' });
}

// ---- waves of the PWM slices, worked out from their registers
function waveAt(pin) {
  if (pin.gpio.functionSelect !== WAVE) return waveIs(pin, 0, 0);
  const number = pin.gpio.index, slice = chip.pwm.channels[number >> 1 & 7];
  const counts = slice.timer.top + 1, high = Math.min((number & 1 ? slice.alarmB : slice.alarmA).target, counts);
  const rises = slice.csr & 2 ? 2 : 1; // phase-correct: it counts up and down
  const inverted = slice.csr & (number & 1 ? 8 : 4);
  const duty = inverted ? 1 - high / counts : high / counts, divider = (slice.div >> 4 || 256) + (slice.div & 15) / 16;
  if (slice.csr & 1 && duty > 0 && duty < 1) return waveIs(pin, chip.clkSys / divider / counts / rises, duty);
  waveIs(pin, 0, 0);
  drives(pin, slice.csr & 1 ? +(duty === 1) : pin.gpio.outputValue ? 1 : 0);
}
function waveIs(pin, hz, duty) {
  const wave = `${hz},${duty}`;
  if (wave === pin.wave) return;
  pin.wave = wave;
  tell(['w', now(), pin.label, hz, duty]);
}
for (const slice of chip.pwm.channels) {
  const report = () => {
    for (const number of [slice.pinA1, slice.pinB1, slice.pinA2, slice.pinB2]) {
      const pin = atNumber[number];
      if (pin !== undefined && pin.gpio.functionSelect === WAVE) waveAt(pin);
    }
  };
  const update = slice.updateDoubleBuffered.bind(slice), writeRegister = slice.writeRegister.bind(slice);
  slice.updateDoubleBuffered = () => {
    const due = slice.ccUpdated || slice.topUpdated;
    update();
    if (due && slice.csr & 1) report();
  };
  slice.writeRegister = (offset, value) => {
    writeRegister(offset, value);
    if (offset === 0) report();
  };
}

// ---- the serial lines of the chip, at the pins that they have: the simulator itself passes bytes only
const SENDING = [[0, 12, 16, 28], [4, 8, 20, 24]]; // the pin after each of them receives
function sender(pin) {
  const line = SENDING.findIndex((numbers) => numbers.includes(pin.gpio.index));
  return line < 0 ? null : line;
}
function receiver(pin) {
  const line = SENDING.findIndex((numbers) => numbers.includes(pin.gpio.index - 1));
  return line < 0 || pin.gpio.functionSelect !== SERIAL ? null : line;
}
chip.uart.forEach((uart, line) => {
  uart.onByte = (byte) => {
    const from = sendAt(line), bit = 1e9 / Math.max(uart.baudRate, 300);
    const bits = [0, ...Array.from({ length: uart.wordLength }, (_, place) => byte >> place & 1), 1];
    for (const number of SENDING[line]) {
      const pin = atNumber[number];
      if (pin === undefined || pin.gpio.functionSelect !== SERIAL) continue;
      bits.forEach((level, place) => {
        if (level !== (place ? bits[place - 1] : 1)) after(from + place * bit - clock.nanos, () => { pin.sends = level; changed(pin); });
      });
    }
  };
});
function heard(pin) { // the falling edge of a start bit
  const line = receiver(pin);
  if (line === null || pin.read || pin.receiving) return;
  const uart = chip.uart[line], bit = 1e9 / Math.max(uart.baudRate, 300), length = uart.wordLength;
  let byte = 0;
  pin.receiving = true;
  for (let place = 0; place < length; place++) after((place + 1.5) * bit, () => { byte |= +pin.read << place; });
  after((length + 1.5) * bit, () => {
    pin.receiving = false;
    if (uart.enabled) uart.feedByte(byte);
  });
}

// ---- the console is on USB: a PC opens it as soon as the device is there
const console_ = new USBCDC(chip.usbCtrl), waiting = [];
let wanted = 0; // bytes that the device has room for
console_.onSerialData = (bytes) => { for (const byte of bytes) tell(['u', now(), byte]); };
const otherEndpoint = chip.usbCtrl.onEndpointRead;
chip.usbCtrl.onEndpointRead = (endpoint, size) => {
  if (endpoint !== console_.outEndpoint) return otherEndpoint(endpoint, size);
  wanted = size;
  deliver();
};
function deliver() { // nothing is sent where there is nothing: rp2040js sends empty packets without end
  if (!wanted || !waiting.length) return;
  const bytes = waiting.splice(0, wanted);
  wanted = 0;
  chip.usbCtrl.endpointReadDone(console_.outEndpoint, Uint8Array.from(bytes));
}

// ---- two-wire buses
function asked(question) {
  answer = null;
  ask({ ask: 'bus', ...question });
  return answer;
}
const ownLines = job.bus ? ownBus(asked, (pin, level) => {
  pin.outside = level;
  settle(pin);
}) : null;
for (const bus of chip.i2c) {
  let address = -1;
  const byteTime = () => 9e9 * (bus.sclLowPeriod + bus.sclHighPeriod) / chip.clkSys || 90000;
  const later = (action) => after(byteTime(), action);
  bus.onConnect = (at, mode) => later(() => {
    address = at;
    bus.completeConnect(!!asked({ bus: 'start', address, read: mode === 1 }));
  });
  bus.onWriteByte = (byte) => later(() => bus.completeWrite(!!asked({ bus: 'write', address, byte })));
  bus.onReadByte = () => later(() => bus.completeRead(asked({ bus: 'read', address })));
  bus.onStop = () => {
    if (address >= 0) asked({ bus: 'stop', address });
    address = -1;
    bus.completeStop();
  };
}

// ---- the run: an instruction, or straight to what comes next while the processor sleeps
chip.adc.channelValues.fill(0);
ask({ ask: 'start' });
let cycle = 1e9 / chip.clkSys;
chip.addClockListener((hertz) => { cycle = 1e9 / hertz; });
const reached = job.reached ? new Uint8Array(chip.flash.length >> 1) : null;
const spins = rounds(chip);
function awake() {
  const { registers } = core;
  spins.disturb();
  do {
    const from = registers[15];
    if (reached !== null && from >>> 28 === 1) reached[(from & 0xffffff) >> 1] = 1;
    const span = core.executeInstruction() * cycle, at = clock.nanosCounter + span, next = clock.nextAlarm;
    if (next !== null && next.nanos <= at) {
      spins.disturb();
      clock.tick(span);
    } else {
      clock.nanosCounter = at;
      if (registers[15] < from) clock.nanosCounter += spins.jumped(at, next === null ? until : Math.min(until, next.nanos));
    }
  } while (clock.nanosCounter < until && !core.waiting && !crashed);
}
function asleep() {
  if (core.pendingInterrupts & core.enabledInterrupts) { // rp2040js sleeps on
    core.waiting = false;
    core.interruptsUpdated = true;
    return;
  }
  let span = Math.max(1, Math.min(job.end, wake) - clock.nanos);
  if (clock.nextAlarm) span = Math.min(span, clock.nanosToNextAlarm);
  if (pio.on()) span = Math.min(span, PIO_SLEEP);
  clock.tick(Math.max(0, span));
}
while (clock.nanosCounter < job.end && !crashed) {
  until = Math.min(job.end, wake, clock.nanosCounter + PIO_STEP);
  if (core.waiting) asleep();
  else awake();
  if (pio.on()) pio.sync();
  if (clock.nanosCounter >= wake) {
    wake = Infinity;
    ask({ ask: 'wake' });
  }
}
const ran = [];
if (reached !== null) reached.forEach((was, half) => { if (was) ran.push(FLASH + 2 * half); });
write({ t: now(), log, ask: 'end', crashed: !!crashed, why: crashed, reached: ran });
