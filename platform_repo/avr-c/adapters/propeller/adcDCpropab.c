//# header adcDCpropab.h
// Voltages on four channels, in C. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Convert/libadcDCpropab (adcDCpropab.h,
// adcDCpropab.c, adcDCVpropab.c).
// The Propeller has no converter; its board has one of four channels and 12 bits at 5 V. Here the microcontroller's own is used.

//# helper adc_channel
//#   fidelity: the converter's channel of a pin; 255 where it has none
static inline uint8_t adc_channel(uint8_t pin) {
  if (pin >= AVR_ADC(0) && pin < 255) return pin - AVR_ADC(0);
  return pin >> 3 == 2 && (pin & 7) < 6 ? pin & 7 : 255;
}

//# helper adc_channel
//#   mcu: atmega2560
//#   fidelity: the converter's channel of a pin; 255 where it has none
static inline uint8_t adc_channel(uint8_t pin) {
  return pin >> 3 == 5 ? pin & 7 : pin >> 3 == 10 ? 8 + (pin & 7) : 255;
}

//# helper adc_channel
//#   mcu: atmega32u4
//#   fidelity: the converter's channel of a pin; 255 where it has none
static inline uint8_t adc_channel(uint8_t pin) {
  switch (pin) {
    case AVR_PIN('D', 4): return 8;
    case AVR_PIN('D', 6): return 9;
    case AVR_PIN('D', 7): return 10;
    case AVR_PIN('B', 4): return 11;
    case AVR_PIN('B', 5): return 12;
    case AVR_PIN('B', 6): return 13;
  }
  uint8_t bit = pin & 7;
  return pin >> 3 == 5 && bit != 2 && bit != 3 ? bit : 255;
}

//# helper analog_counts
//#   needs: adc_channel
//#   fidelity: 4,096 counts of 5 V, in steps of 4
static inline int32_t analog_counts(uint8_t pin) {
  uint8_t channel = adc_channel(pin);
  if (channel == 255) return 0;
#ifdef MUX5
  ADCSRB = channel & 8 ? ADCSRB | _BV(MUX5) : ADCSRB & ~_BV(MUX5);
#endif
  ADMUX = _BV(REFS0) | (channel & 7);
  ADCSRA = _BV(ADEN) | _BV(ADSC) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
  while (ADCSRA & _BV(ADSC)) {}
  return ADC * 4L;
}

//# helper adc_pins
//#   port: adc_0 = adcDCpropab.channel_0 0 analog in
//#   port: adc_1 = adcDCpropab.channel_1 1 analog in
//#   port: adc_2 = adcDCpropab.channel_2 2 analog in
//#   port: adc_3 = adcDCpropab.channel_3 3 analog in
static inline uint8_t adc_pin(int32_t channel) {
  const uint8_t pins[4] = {adc_0, adc_1, adc_2, adc_3};
  return pins[channel & 3];
}

//# adapter adc_init
//#   for: void adc_init(int csPin, int sclPin, int doPin, int diPin)
//#   kind: semantic
//#   needs: adc_pins simpletools.h/Io
//#   symmetric: csPin sclPin doPin diPin
//#   fidelity: the four channels become inputs; the pins given are those of the source board's converter, which is not there
static inline void adc_init(int32_t csPin, int32_t sclPin, int32_t doPin, int32_t diPin) {
  (void)csPin, (void)sclPin, (void)doPin, (void)diPin;
  for (uint8_t channel = 0; channel < 4; channel++) io_drive(io_at(adc_pin(channel)), false);
}

//# adapter adc_in
//#   for: int adc_in(int channel)
//#   kind: oneToOne
//#   needs: adc_pins analog_counts
//#   fidelity: 0 to 4095 for 0 to 5 V, in steps of 4
//#   limit: 10 bits; the reference is the supply of the board
static inline int32_t adc_in(int32_t channel) {
  return analog_counts(adc_pin(channel));
}

//# adapter adc_volts
//#   for: float adc_volts(int channel)
//#   kind: oneToOne
//#   needs: adc_in
//#   fidelity: in steps of 5 mV
//#   limit: 10 bits; the reference is the supply of the board
static inline float adc_volts(int32_t channel) {
  return adc_in(channel) * (5.0f / 4096.0f);
}
