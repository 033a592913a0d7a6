#include "simpletools.h"

#define REGISTER(at) (*(volatile unsigned *)(at))
#define SPEED 0x40

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
}
