#include "simpletools.h"
/* Parameters that are never read are left out. */
int twice(int n) { return 2 * n; }

int main(int argc, char *argv[])
{
  while (1) pause(twice(100));
}
