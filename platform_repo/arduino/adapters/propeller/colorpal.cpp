//# header colorpal.h
// A sensor of colours on a line of one wire. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libcolorpal (colorpal.h, colorpal.c).

//# type colorPal
//#   needs: simpletext.h/text_t
//#   fidelity: a device of text; there are no cogid and devst
typedef text_t colorPal;

//# helper colorPal_reset
//#   needs: colorPal hal/SerialLine simpletext.h/text_t hal/Io
//#   fidelity: exact: the line is low for 80 ms, once the sensor has let it go
inline void colorPal_reset(colorPal *device) {
  SerialLine *line = static_cast<SerialLine *>(device->port);
  if (!line) return;
  line->show(true);
  while (!line->receives.high()) yield();
  line->show(false);
  delay(80);
  line->show(true);
  delay(10);
}

//# helper colorPal_init
//#   needs: colorPal colorPal_reset simpletext.h/writeStr
//#   fidelity: exact: the sensor sends its colours from now on
inline void colorPal_init(colorPal *device) {
  char command[] = "=(00 $ m)!";
  colorPal_reset(device);
  writeStr(device, command);
}

//# adapter colorPal_open
//#   for: colorPal *colorPal_open(int sioPin)
//#   kind: oneToMany
//#   needs: colorPal colorPal_init fdserial.h/FDSERIAL_MODE_OPENDRAIN_TX fdserial.h/open_line
//#   pin: sioPin interrupt both
//#   fidelity: 4,800 baud; a tenth of a second, then the sensor is reset, as there, and its command is sent before the call ends
//#   stack: 47 35
//#   interrupt: PCINT0_vect 41
//#   interrupt: PCINT1_vect 58
//#   interrupt: PCINT2_vect 58
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline colorPal *colorPal_open(int32_t sioPin) {
  colorPal *device = open_line(sioPin, sioPin, FDSERIAL_MODE_OPENDRAIN_TX, 4800);
  delay(100);
  colorPal_init(device);
  return device;
}

//# adapter colorPal_getRGB
//#   for: void colorPal_getRGB(colorPal *device, int *r, int *g, int *b)
//#   kind: oneToMany
//#   needs: colorPal fdserial.h/fdserial_rxFlush simpletext.h/readChar simpletext.h/text_t
//#   fidelity: exact: the next colours, of 12 bits each
//#   limit: 0 at once where the line is not wired
//#   stack: 53 39
template <class Int> inline void colorPal_getRGB(colorPal *device, Int *r, Int *g, Int *b) {
  Int *colours[3] = {r, g, b};
  fdserial_rxFlush(device);
  while (device->port && readChar(device) != '$') {}
  for (Int *colour : colours) {
    char digits[4] = {};
    for (uint8_t number = 0; number < 3; number++) digits[number] = (char)readChar(device);
    *colour = strtol(digits, 0, 16);
  }
}

//# adapter colorPal_close
//#   for: void colorPal_close(colorPal *device)
//#   kind: oneToOne
//#   needs: colorPal fdserial.h/fdserial_close
//#   fidelity: exact
//#   stack: 8 6
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline void colorPal_close(colorPal *device) {
  fdserial_close(device);
}

//# helper in_byte
inline uint8_t in_byte(int32_t value) {
  return value < 0 ? 0 : value > 255 ? 255 : (uint8_t)value;
}

//# adapter colorPalRRGGBB
//#   for: unsigned int colorPalRRGGBB(int r, int g, int b)
//#   kind: oneToOne
//#   needs: in_byte
//#   fidelity: exact: 24 bits of a colour, as corrected there
//#   stack: 0
inline uint32_t colorPalRRGGBB(int32_t r, int32_t g, int32_t b) {
  uint32_t red = in_byte(21 * r / 11 - 65 - r * r / 415), green = in_byte(48 * g / 17 - 70 - g * g / 170);
  return red << 16 | green << 8 | in_byte(8 * b / 9 - 30 - b * b / 1680);
}
