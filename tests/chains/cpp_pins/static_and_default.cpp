#include "simpletools.h"
const int LED = 8;
struct Led { static int pin; int q = LED; };
int Led::pin = LED;
Led l;
int main() { low(LED); while (1) { high(l.q); pause(100); low(Led::pin); high(LED); pause(100); } }
