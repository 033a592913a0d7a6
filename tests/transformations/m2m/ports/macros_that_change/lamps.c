#include "simpletools.h"

#define LAMP 3
#define NEXT (LAMP + 10)
void on(void) { high(LAMP); }                  // => void on(void) { high(port(LAMP)); }
void after(void) { high(NEXT); }               // => void after(void) { high(port(NEXT)); }
#undef LAMP
#define LAMP 4
const int kept = LAMP;                         // => const int kept = LAMP;
void off(void) { low(LAMP); low(NEXT); }       // => void off(void) { low(port(LAMP)); low(port(NEXT)); }
#undef LAMP
enum { LAMP = 5 };
#define BUZZER 7
#undef BUZZER

int main(void) {
  on();
  after();
  off();
  toggle(LAMP);                                // => toggle(LAMP);
  toggle(kept);                                // => toggle(port(kept));
}
