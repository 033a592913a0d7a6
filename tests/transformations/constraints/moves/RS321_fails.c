#include "simpletools.h"
extern unsigned int machine_code[];

int main(void)
{
  cognew(machine_code, 0);  // RS321: cognew(machine_code, 0)
  while (1) pause(10);
}
