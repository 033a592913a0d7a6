#include <stdio.h>
#include <string.h>
int timer0_millis = 70000;
int _delay_ms(int n) { return n + 1; }
int strings(const char *text) { return (int)strlen(text); }
int main(void) {
  int time = 0, clock = 3, strchr = 4;
  while (1) {
    time++;
    clock += strchr;
    strchr++;
    printf("%d %d %d %d %d %d\n", time, clock, strchr, timer0_millis, _delay_ms(5), strings("four"));
  }
}
