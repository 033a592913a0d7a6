#include "simpletools.h"
#include "ping.h"
unsigned int machine[4];
void show(void) { pause(500); }  // RS322

int main(void)
{
  pause(1000);
  cognew(machine, 0);
  while (1) {
    show();
    if (ping_cm(8) < 10)  // RS322
      pause(20);  // RS322
    while (!input(4));  // RS322
    while (input(4)) { }  // RS322
  }
}
