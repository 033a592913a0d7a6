//# header dac2ch.h
// Mean voltages of two channels. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Convert/libdac2ch (dac2ch.h, dac2ch.c).

//# type dac2ch
//#   fidelity: what dac2ch_start gives; its fields are not those of the library
struct dac2ch {
  uint8_t bits;
  uint8_t pins[2];  // 255: none
};

//# type dac2ch_t
//#   needs: dac2ch
//#   fidelity: exact
typedef dac2ch dac2ch_t;

//# adapter dac2ch_start
//#   for: dac2ch *dac2ch_start(int bits)
//#   kind: semantic
//#   needs: dac2ch
//#   fidelity: up to 32 bits, of which the upper 8 count
//#   range: bits 1..8: further bits are left out
//#   stack: 6
inline dac2ch *dac2ch_start(int32_t bits) {
  return new dac2ch{(uint8_t)bits, {255, 255}};
}

//# adapter dac2ch_set
//#   for: void dac2ch_set(dac2ch *device, int pin, int channel, int dacVal)
//#   kind: semantic
//#   needs: dac2ch hal/Io
//#   setup rp2040: analogWriteFreq(20000);
//#   pin: pin pwm out
//#   fidelity avr: the mean voltage, of 8 bits and 5 V; less than nothing makes the pin an input, and so does another pin of the channel
//#   fidelity other: the mean voltage, of 8 bits and the supply of the board; less than nothing makes the pin an input, and so does
//#   fidelity other: another pin of the channel
//#   limit avr: a PWM of 490 or 980 Hz instead of pulses of 12.5 ns: a filter has to be some thousand times slower
//#   limit rp2040: a PWM of 20 kHz instead of pulses of 12.5 ns: a filter has to be some hundred times slower
//#   limit other: a PWM of 1 kHz instead of pulses of 12.5 ns: a filter has to be some thousand times slower
//#   limit avr: full scale is 5 V instead of 3.3 V
//#   stack: 40 24
inline void dac2ch_set(dac2ch *device, int32_t pin, int32_t channel, int32_t dacVal) {
  uint8_t &used = device->pins[channel ? 1 : 0];
  Io io(pin), before(used);
  if (before.wired() && (dacVal < 0 || used != pin)) {
    digitalWrite(used, LOW);  // the timer lets go of it
    before.drive(false);
    used = 255;
  }
  if (dacVal < 0 || !io.wired()) return;
  used = pin;
  int32_t value = device->bits > 8 ? dacVal >> (device->bits - 8) : dacVal << (8 - device->bits);
  analogWrite(pin, value & 0xFF);
}

//# adapter dac2ch_stop
//#   for: void dac2ch_stop(dac2ch *device)
//#   kind: semantic
//#   needs: dac2ch dac2ch_set
//#   fidelity: the pins become inputs
//#   stack: 34 30
inline void dac2ch_stop(dac2ch *device) {
  dac2ch_set(device, 255, 0, -1);
  dac2ch_set(device, 255, 1, -1);
  delete device;
}
