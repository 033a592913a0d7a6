#include "simpletools.h"

#define LOW_SPEED 2
#define min(a, b) ((a) < (b) ? (a) : (b))

int F = 3;
int B1 = 4;
int input_pin = 1;
int word;
static int map[3];
enum { OUTPUT_ON, HIGH = 1 };

void delay(int n) { pause(n); }
int abs(int n) { return n < 0 ? -n : n; }
int digitalRead(int pin) { return input(pin) + F + B1; }

int main()
{
  int A0 = 2;
  int yield = 1;
  high(input_pin);
  low(A0);
  while (1) {
    delay(min(F, abs(-4)));
    word = digitalRead(5) + map[0] + HIGH + yield;
    if (word == OUTPUT_ON) toggle(A0);
  }
}
