// A boot ROM of our own for programs that call the RP2040's, as those of the Pico SDK do: its tables of functions, each a trap that is done here.
// No code of the real ROM. Facts: RP2040 data sheet, "Bootrom contents". Floating point is IEEE with rounding to nearest; the real ROM flushes
// denormals and may differ in the last bit of sin, cos, exp, ... Calls take no time.
'use strict';

const SIZE = 16384, FIRST_TRAP = 0x100, BREAKPOINT = 0xbe00, RETURN = 0x4770, END_OF_ROM = 0x4000;
const I64 = [-(1n << 63n), (1n << 63n) - 1n], U64 = [0n, (1n << 64n) - 1n];

/** Put the ROM into a chip. `crash` is called with why a program cannot go on. Returns what handles a breakpoint: whether it is one of the ROM. */
exports.install = function install(chip, crash) {
  const { core } = chip, R = core.registers;
  const rom = new DataView(new ArrayBuffer(SIZE)), traps = [];
  let free = FIRST_TRAP;
  const align = () => { free = (free + 3) & ~3; };
  function trap(action) {
    const at = free;
    rom.setUint16(at, BREAKPOINT | traps.length, true);
    rom.setUint16(at + 2, RETURN, true);
    traps.push(action);
    free += 4;
    return at | 1;
  }
  const code = (letters) => letters.charCodeAt(0) | letters.charCodeAt(1) << 8;

  // ---- values in registers
  const bits = new DataView(new ArrayBuffer(8));
  const float = (r) => (bits.setUint32(0, R[r], true), bits.getFloat32(0, true));
  const double = (r) => (bits.setUint32(0, R[r], true), bits.setUint32(4, R[r + 1], true), bits.getFloat64(0, true));
  const putFloat = (value) => { bits.setFloat32(0, value, true); R[0] = bits.getUint32(0, true); };
  const putDouble = (value) => { bits.setFloat64(0, value, true); R[0] = bits.getUint32(0, true); R[1] = bits.getUint32(4, true); };
  const put32 = (value) => { R[0] = value | 0; };
  const put64 = (value) => { R[0] = Number(value & 0xffffffffn); R[1] = Number(value >> 32n & 0xffffffffn); };
  const unsigned64 = () => BigInt(R[1] >>> 0) << 32n | BigInt(R[0] >>> 0), signed64 = () => BigInt.asIntN(64, unsigned64());
  const within = (value, least, most) => Number.isNaN(value) ? 0 : Math.max(least, Math.min(most, Math.floor(value)));
  const int = (value) => within(value, -2147483648, 2147483647), uint = (value) => within(value, 0, 4294967295);
  function wide(value, [least, most]) {
    if (Number.isNaN(value)) return 0n;
    if (!Number.isFinite(value)) return value > 0 ? most : least;
    const whole = BigInt(Math.floor(value));
    return whole < least ? least : whole > most ? most : whole;
  }
  const compared = (a, b) => a < b ? -1 : a > b ? 1 : 0;
  function flags(order) {
    core.N = order < 0;
    core.Z = order === 0;
    core.C = order >= 0;
    core.V = false;
  }

  /** The soft floating point functions in the order of their table; a value of `words` registers. */
  function arithmetic(get, put, words, convert) {
    const a = () => get(0), b = () => get(words), scale = (r) => 2 ** (R[r] | 0);
    return [
      () => put(a() + b()), () => put(a() - b()), () => put(a() * b()), () => put(a() / b()),
      () => put32(compared(a(), b())), () => flags(compared(a(), b())), () => put(Math.sqrt(a())),
      () => put32(int(a())), () => put32(int(a() * scale(words))), () => put32(uint(a())), () => put32(uint(a() * scale(words))),
      () => put(R[0] | 0), () => put((R[0] | 0) / scale(1)), () => put(R[0] >>> 0), () => put((R[0] >>> 0) / scale(1)),
      () => put(Math.cos(a())), () => put(Math.sin(a())), () => put(Math.tan(a())), () => crash('sincos of the boot ROM is not simulated'),
      () => put(Math.exp(a())), () => put(Math.log(a())), () => put32(compared(a(), b())), () => put(Math.atan2(a(), b())),
      () => put(Number(signed64())), () => put(Number(signed64()) / scale(2)), () => put(Number(unsigned64())),
      () => put(Number(unsigned64()) / scale(2)), () => put64(wide(a(), I64)), () => put64(wide(a() * scale(words), I64)),
      () => put64(wide(a(), U64)), () => put64(wide(a() * scale(words), U64)), convert,
    ].map(trap);
  }

  function fill() {
    for (let i = 0; i < R[2]; i++) chip.writeUint8(R[0] + i, R[1] & 255);
  }
  function copy() {
    for (let i = 0; i < R[2]; i++) chip.writeUint8(R[0] + i, chip.readUint8(R[1] + i));
  }
  function program() {
    for (let i = 0; i < R[2]; i++) chip.flash[R[0] + i] &= chip.readUint8(R[1] + i);
  }
  function reversed() {
    let from = R[0], to = 0;
    for (let i = 0; i < 32; i++, from >>>= 1) to = to << 1 | from & 1;
    R[0] = to;
  }
  function ones() {
    let count = 0;
    for (let left = R[0]; left; left >>>= 1) count += left & 1;
    R[0] = count;
  }
  const nothing = () => {};
  const functions = Object.entries({
    P3: ones, R3: reversed, L3: () => { R[0] = Math.clz32(R[0]); }, T3: () => { R[0] = R[0] ? 31 - Math.clz32(R[0] & -R[0]) : 32; },
    MS: fill, S4: fill, MC: copy, C4: copy, IF: nothing, EX: nothing, FC: nothing, CX: nothing, DT: nothing, DE: nothing, VW: nothing,
    RE: () => chip.flash.fill(0xff, R[0], R[0] + R[1]), RP: program, UB: () => crash('the program starts the USB boot loader'),
  }).map(([name, action]) => [code(name), trap(action)]);

  /** A table of addresses, with the number of its entries before it. */
  function table(addresses) {
    align();
    rom.setUint16(free + 2, addresses.length, true);
    const at = free + 4;
    addresses.forEach((address, i) => rom.setUint32(at + 4 * i, address, true));
    free = at + 4 * addresses.length;
    return at;
  }
  const floats = table(arithmetic(float, putFloat, 1, () => putDouble(float(0))));
  const doubles = table(arithmetic(double, putDouble, 2, () => putFloat(double(0))));

  /** A list of pairs of code and address, and the pair that ends it. */
  function pairs(list) {
    align();
    const at = free;
    for (const [name, address] of [...list, [0, 0]]) {
      rom.setUint16(free, name, true);
      rom.setUint16(free + 2, address, true);
      free += 4;
    }
    return at;
  }
  const data = [['SF', floats], ['SD', doubles], ['GR', 0x50], ['CR', 0x58]].map(([name, address]) => [code(name), address]);
  const functionList = pairs(functions), dataList = pairs(data);
  const lookUp = trap(() => {
    const wanted = R[1] & 0xffff;
    let at = R[0], name = chip.readUint16(at);
    for (; name && name !== wanted; name = chip.readUint16(at)) at += 4;
    R[0] = name ? chip.readUint16(at + 2) : 0;
  });
  rom.setUint32(0, 0x20041f00, true);
  rom.setUint32(4, 0xef, true);
  rom.setUint32(0x10, 0x0201754d, true); // "Mu", version 2
  rom.setUint16(0x14, functionList, true);
  rom.setUint16(0x16, dataList, true);
  rom.setUint16(0x18, lookUp, true);
  chip.bootrom.set(new Uint32Array(rom.buffer));
  return (number) => {
    const own = core.PC < END_OF_ROM && traps[number] !== undefined;
    if (own) traps[number]();
    return own;
  };
};
