// A two-wire bus that a program makes itself at any two pins, driven low or let go: what it sends is put together from the levels of its pins.
// The line whose fall begins the first transfer carries data, the one that falls next is the clock. Facts: I2C specification (UM10204).
'use strict';

const ADDRESS = 0, SENT = 1, ASKED = 2; // what the byte under way is

/** `asked(question)` asks the devices; `pull(pin, level)` drives a pin from outside: 0, or null. Returns what is to be called when a pin's level changed. */
exports.bus = function bus(asked, pull) {
  let data = null, clock = null; // the lines, when they are known
  let under = null; // the transfer: what its byte is, the bits so far, how many, its address
  const high = (pin) => pin.level !== 0;

  function begin() {
    under = { what: ADDRESS, byte: 0, count: 0, address: under === null ? -1 : under.address };
    pull(data, null);
  }
  function end() {
    if (under !== null && under.address >= 0) asked({ bus: 'stop', address: under.address });
    under = null;
    pull(data, null);
  }
  function rises() { // a bit is valid
    if (under === null) return;
    under.count++;
    if (under.count <= 8) under.byte = under.byte << 1 & 0xff | +data.read;
    else if (under.what === ASKED && data.read) under.what = null; // it was the last byte
  }
  function falls() { // the next bit may be set
    if (under === null) return;
    if (under.count === 8 && under.what !== ASKED) {
      const { byte } = under;
      if (under.what === ADDRESS) {
        under.address = byte >> 1;
        under.reads = !!(byte & 1);
        under.heard = !!asked({ bus: 'start', address: under.address, read: under.reads });
      } else under.heard = !!asked({ bus: 'write', address: under.address, byte });
      pull(data, under.heard ? 0 : null);
      if (!under.heard) under.what = null;
    } else if (under.count === 8) pull(data, null); // the program acknowledges
    else if (under.count === 9) {
      if (under.what !== null) under.what = under.reads ? ASKED : SENT;
      under.count = under.byte = 0;
      pull(data, null);
      if (under.what === ASKED) under.sends = asked({ bus: 'read', address: under.address });
    }
    if (under.what === ASKED && under.count < 8) pull(data, under.sends >> 7 - under.count & 1 ? null : 0);
  }

  return (pin, before) => {
    const was = before !== 0, is = high(pin);
    if (was === is) return;
    if (clock === null) {
      if (is) {
        if (pin === data) data = null;
      } else if (before === 'p' && data === null) data = pin;
      else if (before === 'p' && pin !== data) {
        clock = pin;
        begin();
        falls();
      }
    } else if (pin === clock) (is ? rises : falls)();
    else if (pin === data && high(clock)) (is ? end : begin)();
  };
};
