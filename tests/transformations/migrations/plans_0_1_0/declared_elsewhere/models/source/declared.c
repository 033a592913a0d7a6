#include "simpletools.h"

int adc_average(int channel, const char *label);
void kick(void);

int main()
{
  while (1) {
    kick();
    pause(adc_average(2, "light"));
  }
}
