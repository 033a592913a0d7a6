#include "simpletools.h"

int main(void);
int twice(int n);          // declared, then defined
static float half(float x);

int main(void)
{
  int n = twice(2);
  late(n);
  while (1) {
    n = twice(n);
    half(n);
    pause(n);
  }
}

int twice(int n) { return 2 * n; }
static float half(float x) { return x / 2; }
void late(int n) { pause(n); }
int twice(int n);
