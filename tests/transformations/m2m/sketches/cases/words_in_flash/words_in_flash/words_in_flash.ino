// Words in the program memory, by a table of pointers.
#include <avr/pgmspace.h>

const char first[] PROGMEM = "left";
const char second[] PROGMEM = "right";
const char *const table[] PROGMEM = {first, second};
const int pauses[] PROGMEM = {30, -500, 60};

char text[10];

void setup() {
  Serial.begin(9600);
  pinMode(8, OUTPUT);
}

void loop() {
  for (int i = 0; i < 2; i++) {
    strcpy_P(text, (char *)pgm_read_word(&(table[i])));
    Serial.println(text);
    digitalWrite(8, i);
    int pause = (int)pgm_read_word(&pauses[i]);
    if (pause < 0) pause = 45;
    delay(pause);
  }
}
