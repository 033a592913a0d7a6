#include "simpletools.h"

const int buttonPin = 3;
#define LED_PIN 26
#define PINS_PER_SIDE (2)
enum { SENSOR_PIN = 7, BUZZER_PIN };
static const int rows[3] = {10, 11, 12};
int relay = 15;

void pulse(int pin)
{
  high(pin);
  low(pin);
}

int main()
{
  int i;
  while (1) {
    if (input(buttonPin)) high(LED_PIN);
    if (input(SENSOR_PIN)) pulse(BUZZER_PIN);
    pulse(4);
    high(relay);
    for (i = 0; i < 3; i++) low(rows[i]);
    freqout(BUZZER_PIN, 100, 3000);
    pause(100);
  }
}
