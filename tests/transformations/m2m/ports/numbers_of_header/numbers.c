#include "simpletools.h"
#include "adcDCpropab.h"
#include "ping.h"
#include "pins.h"

#define LONG (24L * 0x1FUL)  // => #define LONG (24L * 0x1FUL)

int main() {
  int far;  // => int far;
  while (1) {
    far = ping_cm(PING_PIN);
    pause(LONG % far);  // => pause(LONG % far);
    print("%f\n", adc_volts(CHANNEL));  // => print("%f\n", adc_volts(CHANNEL));
  }
}
