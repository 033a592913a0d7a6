#include "simpletools.h"
#include "mysteries.h"

int main()
{
  int n = mystery_read(3, 4);
  float f = 1.5;
  char text[10];
  mystery_start();
  while (1) {
    n = mystery_read(n, 2);
    mystery_show("n = ", n, f);
    mystery_fill(text, sizeof(text));
    if (mystery_ready()) pause(n);
  }
}
