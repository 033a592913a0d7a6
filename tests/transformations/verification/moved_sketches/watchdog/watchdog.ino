// A dog that is fed, a lamp that blinks.
#include <avr/wdt.h>

bool lit = false;

void setup() {
  pinMode(6, OUTPUT);
  wdt_enable(WDTO_500MS);
}

void loop() {
  wdt_reset();
  lit = !lit;
  digitalWrite(6, lit);
  delay(30);
}
