/* Tries the library out. */
#include "simpletools.h"
#include "ping.h"

int main()
{
  while (1) print("%d\n", ping_cm(15));
}
