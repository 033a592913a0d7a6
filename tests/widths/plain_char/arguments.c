#include "simpletools.h"
struct s { char t; } m = {200};
char arr[] = {200, 100};
char ret(void) { return 200; }
int widened(void) { char c = 220; return c; }
void own(int x) { print("own %d\n", x); }
void kr(x) int x; { print("kr %d\n", x); }
void blink(int p, char c) { high(p); pause(c); low(p); }
int main(void) {
  char c = 200, *q = &c;
  pause(c); pause(arr[0]); pause(m.t); pause((char)456); pause(*q); pause(ret()); pause(1 ? c : 3); pause(c++);
  print("%d %d %c\n", c, arr[0], 65);
  putChar(c); own(c); kr(c);
  print("%d\n", widened());
  freqout(4, c, 1000);
  servo_angle(5, c);
  blink(3, 200);
  print("%d\n", (int)c);
}
