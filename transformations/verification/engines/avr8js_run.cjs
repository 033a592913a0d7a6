// Runs a program on avr8js (npm, MIT), for the engine `avr8js`. Talks with it in lines of JSON, one question and one answer at a time:
// questions go to standard output, answers come from standard input. The first line that arrives is the job.
//   question: {t, log: [["p", t, label, level] | ["w", t, address, value] | ["u", t, byte] ...], ask: why, ...}   t in cycles
//   answer:   [["set", label, 0|1|null] | ["join"|"part", label, label] | ["adc", channel, volts] | ["send", [bytes]] | ["wake", cycle] ...]
'use strict';
const fs = require('fs');
const avr = require('avr8js');

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
const program = new Uint16Array(0x8000 / 2);
const bytes = new Uint8Array(program.buffer);
let high = 0, end = 0; // end: the first byte after the program
for (const line of job.hex.split('\n')) {
  if (line[0] !== ':') continue;
  const count = parseInt(line.slice(1, 3), 16), address = parseInt(line.slice(3, 7), 16), kind = line.slice(7, 9);
  if (kind === '00') end = Math.max(end, high + address + count);
  if (kind === '00') for (let i = 0; i < count; i++) bytes[high + address + i] = parseInt(line.slice(9 + 2 * i, 11 + 2 * i), 16);
  else if (kind === '02') high = parseInt(line.slice(9, 13), 16) * 16;
  else if (kind === '04') high = parseInt(line.slice(9, 13), 16) * 65536;
}
const cpu = new avr.CPU(program, 2048);
const clock = job.clock;
new avr.AVRClock(cpu, clock, avr.clockConfig);
for (const config of [avr.timer0Config, avr.timer1Config, avr.timer2Config]) new avr.AVRTimer(cpu, config);
new avr.AVREEPROM(cpu, new avr.EEPROMMemoryBackend(1024), avr.eepromConfig);
const bus = new avr.AVRTWI(cpu, avr.twiConfig, clock);
new avr.AVRSPI(cpu, avr.spiConfig, clock);
const adc = new avr.AVRADC(cpu, avr.adcConfig);
const usart = new avr.AVRUSART(cpu, avr.usart0Config, clock);
const ports = {
  B: [new avr.AVRIOPort(cpu, avr.portBConfig), avr.portBConfig],
  C: [new avr.AVRIOPort(cpu, avr.portCConfig), avr.portCConfig],
  D: [new avr.AVRIOPort(cpu, avr.portDConfig), avr.portDConfig],
};

let log = [];
let wake = Infinity;
function ask(question) {
  write({ t: cpu.cycles, log, ...question });
  log = [];
  for (const [what, a, b] of readLine()) {
    if (what === 'set') {
      pins[a].outside = b;
      settle(pins[a]);
    } else if (what === 'join' || what === 'part') {
      for (const [end, other] of [[pins[a], pins[b]], [pins[b], pins[a]]]) {
        end.contact = what === 'join' ? other : null;
        settle(end);
      }
    } else if (what === 'adc') adc.channelValues[a] = b;
    else if (what === 'send') for (const byte of a) waiting.push(byte);
    else if (what === 'wake') wake = a === null ? Infinity : a;
    else answer = a;
  }
  deliver();
}
let answer = null;

// ---- pins. What is read at an input: what the program drives at the other end of a contact, else what drives it from outside,
// else its pull-up, else what was there last.
const pins = {};
const atPort = { B: [], C: [], D: [] };
for (const [label, place] of Object.entries(job.pins)) {
  const pin = { label, port: ports[place[0]][0], config: ports[place[0]][1], bit: +place[1], level: 'z', outside: null, contact: null };
  pins[label] = pin;
  atPort[place[0]].push(pin);
}
function settle(pin) {
  const driven = pin.contact === null ? 'z' : pin.contact.level;
  if (driven !== 'z') pin.port.setPin(pin.bit, driven !== 0);
  else if (pin.outside !== null) pin.port.setPin(pin.bit, !!pin.outside);
  else if (pin.level === 'p') pin.port.setPin(pin.bit, true);
}
const reactive = new Set(job.reactive), brief = new Set(job.brief), told = new Set();
for (const [name, mine] of Object.entries(atPort)) {
  const [port, config] = ports[name];
  port.addListener(() => {
    const output = cpu.data[config.DDR], value = cpu.data[config.PORT];
    let telling = false;
    for (const pin of mine) {
      const one = value >> pin.bit & 1;
      const level = output >> pin.bit & 1 ? one : one ? 'p' : 'z';
      if (level === pin.level) continue;
      if (pin.level === 0 || pin.level === 1) pin.port.setPin(pin.bit, !!pin.level);
      pin.level = level;
      settle(pin);
      if (pin.contact !== null) settle(pin.contact);
      if (brief.has(pin.label)) {
        if (told.has(pin.label + level)) continue;
        told.add(pin.label + level);
      }
      log.push(['p', cpu.cycles, pin.label, level]);
      telling = telling || reactive.has(pin.label);
    }
    if (telling) ask({ ask: 'pins' });
    else if (log.length > 20000) ask({ ask: 'log' });
  });
}

// ---- timers: every write of these registers, before what the simulator does with it
for (const address of job.registers) {
  const inner = cpu.writeHooks[address];
  cpu.writeHooks[address] = (value, old, at, mask) => {
    log.push(['w', cpu.cycles, address, value]);
    return inner ? inner(value, old, at, mask) : undefined;
  };
}

// ---- console
const waiting = [];
function deliver() {
  if (waiting.length && !usart.rxBusy && usart.writeByte(waiting[0])) waiting.shift();
}
usart.onRxComplete = deliver;
usart.onByteTransmit = (byte) => log.push(['u', cpu.cycles, byte]);

// ---- two-wire bus
let address = -1;
function asked(question) {
  answer = null;
  ask({ ask: 'bus', ...question });
  return answer;
}
bus.eventHandler = {
  start() { bus.completeStart(); },
  stop() { asked({ bus: 'stop', address }); address = -1; bus.completeStop(); },
  connectToSlave(at, writing) { address = at; bus.completeConnect(!!asked({ bus: 'start', address, read: !writing })); },
  writeByte(byte) { bus.completeWrite(!!asked({ bus: 'write', address, byte })); },
  readByte() { bus.completeRead(asked({ bus: 'read', address })); },
};

ask({ ask: 'start' });
const beyond = (end + 1) >> 1;
let crashed = false;
const reached = new Uint8Array(program.length), jumped = new Uint8Array(program.length), passed = new Uint8Array(program.length);
while (cpu.cycles < job.end) {
  const at = cpu.pc;
  reached[at] = 1;
  avr.avrInstruction(cpu);
  (cpu.pc === at + 1 ? passed : jumped)[at] = 1;
  if (cpu.pc >= beyond) { // it has left the program; avr8js would go through the empty memory and begin again
    crashed = true;
    break;
  }
  cpu.tick();
  if (cpu.cycles >= wake) {
    wake = Infinity;
    ask({ ask: 'wake' });
  }
  if (waiting.length) deliver();
}
const marked = (marks) => (job.reached ? [...marks.keys()].filter((word) => marks[word]).map((word) => 2 * word) : []);
write({
  t: cpu.cycles, log, ask: 'end', crashed, baud: usart.baudRate, reached: marked(reached), jumped: marked(jumped), passed: marked(passed),
});
