#include <avr/pgmspace.h>

const char open_text[] PROGMEM = "open";
const char shut_text[] PROGMEM = "shut";
const char *const texts[] PROGMEM = {open_text, shut_text};
const int tones[][2] PROGMEM = {{262, 200}, {294, 100}};
const uint16_t steps[] PROGMEM = {1, 40000};
const int offsets[] PROGMEM = {-3, 4};
char shown[8];

void setup() {
  strcpy_P(shown, (char *)pgm_read_word(&(texts[1])));
  strcpy_P(shown, (const char *)pgm_read_word(texts + 1));
}

void loop() {
  tone(8, pgm_read_word_near(&tones[1][0]));
  delay(pgm_read_word(&steps[0]));
  int offset = pgm_read_word(&offsets[0]);
  if (offset < 0) noTone(8);
  uint16_t address = pgm_read_word(&texts[0]);
  if (address) noTone(8);
}
