#include "simpletools.h"
#define HIGH_SPEED 70000
#define ON 1
#define OFF 0
int A0 = 40000, B0 = 3, random_ = 4;
int F(int x) { return x * 2; }
int word = 5, byte = 6;
typedef int boolean;
int map(int a) { return a + 1; }
int bit(int n) { return 1 << n; }
struct String { int n; };
enum { LED_BUILTIN = 77, SS = 78, MOSI, PI_ = 3 };
#define PI 314
#define SQUARE(x) ((x) * (x))
int setup(int a) { return a + 70000; }
void loop(void) { printf("loop of mine\n"); }
int delay(int ms) { return ms * 100; }
int min(int a, int b) { return a < b ? a : b; }
int round2(int v) { return v; }
static boolean yield = 1;
int Serial = 12, Wire = 13, EEPROM = 14;
int class = 15, new = 16, delete = 17, this = 18, private = 19, template = 20, try = 21, and = 22, or = 23, not = 24;
int interrupts = 1, analogRead = 2, digitalWrite = 3, millis = 50000, micros = 5, tone = 6, shiftOut_ = 7, init = 8, constrain = 9;
int INPUT_ = 1, LOW_ = 2, DEC = 3, HEX = 4, BIN = 5, PB0 = 6, PORTB = 7, TCNT1 = 8, SP = 9, sq = 10, lowByte = 11, bitRead = 12;
int main()
{
  struct String String = { 3 };
  boolean true_ = ON;
  printf("%d %d %d %d %d\n", A0, B0, F(40000), word, byte);
  printf("%d %d %d %d\n", map(70000), bit(17), String.n, LED_BUILTIN + SS + MOSI);
  printf("%d %d %d\n", PI, SQUARE(300), setup(1));
  loop();
  printf("%d %d %d %d\n", delay(1000), min(70000, 80000), yield, true_);
  printf("%d\n", Serial + Wire + EEPROM + class + new + delete + this + private + template + try + and + or + not);
  printf("%d\n", interrupts + analogRead + digitalWrite + millis + micros + tone + init + constrain);
  printf("%d\n", DEC + HEX + BIN + PB0 + PORTB + TCNT1 + SP + sq + lowByte + bitRead + HIGH_SPEED + OFF);
  return 0;
}
