#include "simpletools.h"

#define LED 26      // the light
#define BUTTON (3)  /* the button */
static const int buzzer = 4, relay = 5;  // both
const int sensor /* left */ = /* was 2 */ 7;

int main()
{
  while (1) {
    if (input(BUTTON)) high(LED);
    toggle(buzzer);
    toggle(relay);
    pause(input(sensor));
  }
}
