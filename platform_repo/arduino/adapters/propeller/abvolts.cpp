//# header abvolts.h
// Voltages of the ActivityBot's board, in and out. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Convert/libabvolts (abvolts.h, abvolts.c, abvoltsF.c, abvoltsDA.c, daVolts.c).
// The Propeller has no converter; its board has one of four channels and 12 bits at 5 V. Here the microcontroller's own is used.

//# helper ad_pins
//#   port: ad_0 = abvolts.channel_0 0 analog in
//#   port: ad_1 = abvolts.channel_1 1 analog in
//#   port: ad_2 = abvolts.channel_2 2 analog in
//#   port: ad_3 = abvolts.channel_3 3 analog in
const uint8_t ad_pins[4] = {ad_0, ad_1, ad_2, ad_3};

//# adapter ad_init
//#   for: void ad_init(int csPin, int sclPin, int doPin, int diPin)
//#   kind: semantic
//#   needs: ad_pins hal/Io
//#   symmetric: csPin sclPin doPin diPin
//#   fidelity: the four channels become inputs; the pins given are those of the source board's converter, which is not there
//#   stack: 4 0
inline void ad_init(int32_t csPin, int32_t sclPin, int32_t doPin, int32_t diPin) {
  (void)csPin, (void)sclPin, (void)doPin, (void)diPin;
  for (uint8_t pin : ad_pins) Io(pin).drive(false);
}

//# adapter ad_in
//#   for: int ad_in(int channel)
//#   kind: oneToOne
//#   needs: ad_pins hal/analog_counts
//#   fidelity avr: 0 to 4095 for 0 to 5 V, in steps of 4
//#   fidelity rp2040: 0 to 2703 for 0 to 3.3 V: the numbers are those of 5 V, as there
//#   fidelity other: 0 to 4095 for 0 to 5 V, as far as the reference of the board goes
//#   limit avr: 10 bits; the reference is the supply of the board
//#   limit rp2040: pins bear 3.3 V at most: a higher voltage needs a divider, and no more than 3.3 V is read
//#   limit other: the reference of the board limits what is read
//#   stack: 2 0
inline int32_t ad_in(int32_t channel) {
  return analog_counts(ad_pins[channel & 3]);
}

//# adapter ad_volts
//#   for: float ad_volts(int channel)
//#   kind: oneToOne
//#   needs: ad_in
//#   fidelity avr: in steps of 5 mV
//#   fidelity other: in steps of 1.2 mV
//#   limit avr: 10 bits; the reference is the supply of the board
//#   limit rp2040: pins bear 3.3 V at most: a higher voltage needs a divider, and no more than 3.3 V is read
//#   limit other: the reference of the board limits what is read
//#   stack: 10 0
inline float ad_volts(int32_t channel) {
  return ad_in(channel) * (5.0f / 4096.0f);
}

//# helper da_scale
//#   fidelity: what da_volts multiplies voltages with, per channel
//#   ram: 8
static float da_scale[2] = {1.0f, 1.0f};

//# helper da_bits
//#   ram: 1
static uint8_t da_bits = 8;

//# helper da_pins
//#   port: da_0 = abvolts.output_0 26 pwm out
//#   port: da_1 = abvolts.output_1 27 pwm out
//#   ram: 2
static uint8_t da_pins[2] = {da_0, da_1};

//# adapter da_init
//#   for: void da_init(int pinDA0, int pinDA1)
//#   kind: oneToOne
//#   needs: da_pins
//#   pin: pinDA0 pwm out
//#   pin: pinDA1 pwm out
//#   fidelity: exact
//#   stack: 0
inline void da_init(int32_t pinDA0, int32_t pinDA1) {
  da_pins[0] = pinDA0;
  da_pins[1] = pinDA1;
}

//# adapter da_res
//#   for: void da_res(int bits)
//#   kind: oneToOne
//#   needs: da_bits
//#   fidelity: exact; more than 8 bits are cut to 8
//#   stack: 0
inline void da_res(int32_t bits) {
  da_bits = bits ? bits : 8;
}

//# adapter da_out
//#   for: void da_out(int channel, int daVal)
//#   kind: semantic
//#   needs: da_bits da_pins
//#   setup rp2040: analogWriteFreq(20000);
//#   fidelity avr: the mean voltage, of 8 bits and 5 V
//#   fidelity other: the mean voltage, of 8 bits and the supply of the board
//#   limit avr: a PWM of 490 or 980 Hz instead of pulses of 12.5 ns: a filter has to be some thousand times slower
//#   limit rp2040: a PWM of 20 kHz instead of pulses of 12.5 ns: a filter has to be some hundred times slower
//#   limit other: a PWM of 1 kHz instead of pulses of 12.5 ns: a filter has to be some thousand times slower
//#   limit avr: full scale is 5 V instead of 3.3 V
//#   stack: 6 2
inline void da_out(int32_t channel, int32_t daVal) {
  uint8_t pin = da_pins[channel ? 1 : 0];
  int32_t value = da_bits > 8 ? daVal >> (da_bits - 8) : daVal << (8 - da_bits);
  if (pin < NUM_DIGITAL_PINS) analogWrite(pin, value & 0xFF);
}

//# adapter da_volts
//#   for: void da_volts(int channel, float daVal)
//#   kind: semantic
//#   needs: da_out da_bits da_scale hal/output_volts
//#   fidelity avr: so many volts in the mean, of the 5 V of this board; no more than 3.3 V, as there
//#   fidelity other: so many volts in the mean, no more than 3.3 V, as there
//#   limit avr: a PWM of 490 or 980 Hz instead of pulses of 12.5 ns: a filter has to be some thousand times slower
//#   limit rp2040: a PWM of 20 kHz instead of pulses of 12.5 ns: a filter has to be some hundred times slower
//#   limit other: a PWM of 1 kHz instead of pulses of 12.5 ns: a filter has to be some thousand times slower
//#   stack: 18 8
inline void da_volts(int32_t channel, float daVal) {
  float most = (float)(1L << da_bits);
  da_out(channel, (int32_t)constrain(constrain(daVal * da_scale[channel & 1], 0.0f, 3.3f) * most / output_volts + 0.5f, 0.0f, most - 1));
}

//# constant _abvolts_EE_start_
//#   fidelity: exact
#define _abvolts_EE_start_ 63400L

//# adapter da_setupScale
//#   for: void da_setupScale(void)
//#   kind: semantic
//#   needs: _abvolts_EE_start_ da_pins da_scale ad_volts hal/output_volts simpletools.h/ee_putFloat32 simpletools.h/ee_putStr simpletools.h/high hal/Io simpletools.h/low simpletext.h/print
//#   fidelity: both outputs are read back 40 times through the first two channels, and the ratio to 3.3 V is kept in EEPROM, as there
//#   limit avr: outputs are high at 5 V here, which is the reading of a right circuit; the words that it prints are others than there
//#   limit other: the words that it prints are others than there
//#   stack: 311 295
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void da_setupScale() {
  float sums[2] = {0, 0};
  for (uint8_t side = 0; side < 2; side++) high(da_pins[side]);
  delay(5);
  for (uint8_t turn = 0; turn < 40; turn++) {
    for (uint8_t side = 0; side < 2; side++) {
      float volts = ad_volts(side);
      if (!turn && (volts < 0.94f * output_volts || volts > 1.06f * output_volts)) {
        print("Error\n");
        return;
      }
      sums[side] += volts;
    }
  }
  ee_putStr("abvolts", 8, _abvolts_EE_start_);
  for (uint8_t side = 0; side < 2; side++) {
    da_scale[side] = output_volts / (sums[side] / 40);
    ee_putFloat32(da_scale[side], _abvolts_EE_start_ + 8 + 4 * side);
    low(da_pins[side]);
    Io(da_pins[side]).drive(false);
  }
  print("Ch0 scalar = %f\nCh1 scalar = %f\n\n", da_scale[0], da_scale[1]);
}

//# adapter da_useScale
//#   for: void da_useScale(void)
//#   kind: oneToMany
//#   needs: _abvolts_EE_start_ da_scale simpletools.h/ee_getFloat32 simpletools.h/ee_getStr
//#   fidelity: exact: what da_setupScale has kept, nothing without it
//#   stack: 0 12
inline void da_useScale() {
  char mark[8];
  ee_getStr(mark, 8, _abvolts_EE_start_);
  if (strncmp(mark, "abvolts", 8)) return;
  for (uint8_t side = 0; side < 2; side++) da_scale[side] = ee_getFloat32(_abvolts_EE_start_ + 8 + 4 * side);
}

//# adapter da_stop
//#   for: void da_stop(void)
//#   kind: semantic
//#   needs: da_pins hal/Io
//#   fidelity: both pins become inputs, as when the library's cog stops
//#   stack: 7 0
inline void da_stop() {
  for (uint8_t pin : da_pins) {
    Io io(pin);
    if (!io.wired()) continue;
    digitalWrite(pin, LOW);  // the timer lets go of it
    io.drive(false);
  }
}
