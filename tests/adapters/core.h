// What the programs of cases use of the Arduino core, for C.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define HEX 16
#define BIN 2
#define OUTPUT 1
#define INPUT 0
#define HIGH 1
#define LOW 0
#define F(text) text
#define yield() (void)0
#define delay(ms) clock_wait(ms)
#define micros() clock_us()
#define millis() (clock_us() / 1000)

static inline volatile uint8_t *core_port(uint8_t pin) {
  return pin < 8 ? &PIND : pin < 14 ? &PINB : &PINC;
}

static inline uint8_t core_mask(uint8_t pin) {
  return 1 << (pin < 8 ? pin : pin < 14 ? pin - 8 : pin - 14);
}

static inline void pinMode(uint8_t pin, uint8_t mode) {
  if (mode) core_port(pin)[1] |= core_mask(pin);
  else core_port(pin)[1] &= ~core_mask(pin);
}

static inline void digitalWrite(uint8_t pin, uint8_t value) {
  if (value) core_port(pin)[2] |= core_mask(pin);
  else core_port(pin)[2] &= ~core_mask(pin);
}

static inline bool digitalRead(uint8_t pin) {
  return *core_port(pin) & core_mask(pin);
}

static inline void Serial_begin(uint32_t baud) {
  UCSR0A = _BV(U2X0);
  UBRR0 = (F_CPU / 4 / baud - 1) / 2;
  UCSR0B |= _BV(TXEN0);
}

static inline void Serial_flush(void) {
  while (!(UCSR0A & _BV(UDRE0))) {}
}

static inline void Serial_write(uint8_t byte) {
  Serial_flush();
  UDR0 = byte;
}

static inline void core_text(const char *text) {
  for (; *text; text++) {
    Serial_flush();
    UDR0 = *text;
  }
}

static inline void core_signed(int32_t value, uint8_t base) {
  char text[34];
  if (base == 10) ltoa(value, text, 10);
  else ultoa(value, text, base);
  core_text(strupr(text));
}

static inline void core_unsigned(uint32_t value, uint8_t base) {
  char text[34];
  core_text(strupr(ultoa(value, text, base)));
}

static inline void core_real(double value, uint8_t places) {
  char text[40];
  core_text(dtostrf(value, 1, places == 10 ? 2 : places, text));
}

static inline void core_char(char value, uint8_t base) {
  char text[2] = {value, 0};
  (void)base;
  core_text(text);
}

static inline void core_words(const void *text, uint8_t base) {
  (void)base;
  core_text(text);
}

#define CORE_PRINT(value, base, ...) \
  _Generic((value), char: core_char, float: core_real, double: core_real, char *: core_words, const char *: core_words, void *: core_words, \
           uint32_t: core_unsigned, uint16_t: core_unsigned, uint8_t: core_unsigned, default: core_signed)(value, base)
#define Serial_print(...) CORE_PRINT(__VA_ARGS__, 10, 0)
#define Serial_println(...) (CORE_PRINT(__VA_ARGS__, 10, 0), core_text("\r\n"))
