#include "simpletools.h"

int first(void) { return 5; }

int main()
{
  int limit = 10;            // a constant value
  int start = first();       // a call
  const int step = 2;
  const int offset = first() + 1;
  static int calls = 0;
  int values[3] = {1, 2, 3};
  char name[] = "robot";
  char *text = name;
  const char *fixed = "fixed";
  float ratio = 1.5f;
  unsigned char flag;
  int once = 7;
  flag = 0;
  pause(once);
  while (1) {
    calls += step + offset;
    values[calls % 3] = limit + start;
    flag = !flag;
    ratio = ratio * values[0] + flag;
    text[0] = fixed[0];
    pause(calls);
  }
}
