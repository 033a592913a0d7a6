//# header adcDCpropab.h
// Voltages on four channels. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Convert/libadcDCpropab (adcDCpropab.h, adcDCpropab.c, adcDCVpropab.c).
// The Propeller has no converter; its board has one of four channels and 12 bits at 5 V. Here the microcontroller's own is used.

//# helper adc_pins
//#   port: adc_0 = adcDCpropab.channel_0 0 analog in
//#   port: adc_1 = adcDCpropab.channel_1 1 analog in
//#   port: adc_2 = adcDCpropab.channel_2 2 analog in
//#   port: adc_3 = adcDCpropab.channel_3 3 analog in
const uint8_t adc_pins[4] = {adc_0, adc_1, adc_2, adc_3};

//# adapter adc_init
//#   for: void adc_init(int csPin, int sclPin, int doPin, int diPin)
//#   kind: semantic
//#   needs: adc_pins hal/Io
//#   symmetric: csPin sclPin doPin diPin
//#   fidelity: the four channels become inputs; the pins given are those of the source board's converter, which is not there
//#   stack: 4 0
inline void adc_init(int32_t csPin, int32_t sclPin, int32_t doPin, int32_t diPin) {
  (void)csPin, (void)sclPin, (void)doPin, (void)diPin;
  for (uint8_t pin : adc_pins) Io(pin).drive(false);
}

//# adapter adc_in
//#   for: int adc_in(int channel)
//#   kind: oneToOne
//#   needs: adc_pins hal/analog_counts
//#   fidelity avr: 0 to 4095 for 0 to 5 V, in steps of 4
//#   fidelity rp2040: 0 to 2703 for 0 to 3.3 V: the numbers are those of 5 V, as there
//#   fidelity other: 0 to 4095 for 0 to 5 V, as far as the reference of the board goes
//#   limit avr: 10 bits; the reference is the supply of the board
//#   limit rp2040: pins bear 3.3 V at most: a higher voltage needs a divider, and no more than 3.3 V is read
//#   limit other: the reference of the board limits what is read
//#   stack: 2 0
inline int32_t adc_in(int32_t channel) {
  return analog_counts(adc_pins[channel & 3]);
}

//# adapter adc_volts
//#   for: float adc_volts(int channel)
//#   kind: oneToOne
//#   needs: adc_in
//#   fidelity avr: in steps of 5 mV
//#   fidelity other: in steps of 1.2 mV
//#   limit avr: 10 bits; the reference is the supply of the board
//#   limit rp2040: pins bear 3.3 V at most: a higher voltage needs a divider, and no more than 3.3 V is read
//#   limit other: the reference of the board limits what is read
//#   stack: 10 0
inline float adc_volts(int32_t channel) {
  return adc_in(channel) * (5.0f / 4096.0f);
}
