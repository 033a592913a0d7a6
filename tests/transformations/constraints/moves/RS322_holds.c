#include "simpletools.h"
/* What waits is done once. */
int main(void)
{
  pause(1000);
  while (1) toggle(26);
}
