#include "simpletools.h"

#include <string.h>

#define REGISTER(at) (*(volatile unsigned *)(at))
#define SPEED 0x40

static const int AT = 0x44;

struct Mailbox { int command, value; };

int main(void)
{
  int frequency = *(int *)0;  // RS351
  volatile char *bytes = (volatile char *)0x7000;  // RS351
  struct Mailbox *box;
  box = (struct Mailbox *)(0x7f00 + 4);  // RS351
  bytes[0] = frequency;
  ((volatile int *)SPEED)[2] = 1;  // RS351
  ((struct Mailbox *)0x100)->value = box->value;  // RS351
  REGISTER(0x24) = 255;  // RS351
  int *cell = (int *)(unsigned)0x24;  // RS351
  cell = (int *)AT;  // RS351
  memset((void *)0x24, 255, 4);  // RS351
  strcpy((char *)0x7000, "x");  // RS351
}
