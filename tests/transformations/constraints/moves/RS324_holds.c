#include "simpletools.h"
#include <time.h>
/* The header is included; of string.h the target has everything anyway. */
long now;
char name[8];

int main(void)
{
  now = time(0) + strlen(name);
}
