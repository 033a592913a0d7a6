#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
/* What fits, what has no sign there either, what is made a character of, and what has 32 bits by its own type. */
jmp_buf again;
char buffer[8], *taken;
long sum;

int main(void)
{
  taken = malloc(40000);
  memset(buffer, 0xFFFFFFFF, sizeof(buffer));
  memcpy(buffer, taken, -1);
  sum = labs(-70000);
  longjmp(again, -5);
}
