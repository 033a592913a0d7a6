#include "simpletools.h"
/* A driver that another core starts gets the address of its mailbox. */
struct mailbox { int pin; };

int main(struct mailbox *box)  // RS344: struct mailbox *box
{
  high(box->pin);
  while (1) toggle(3);
}
