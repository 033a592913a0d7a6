#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <ctype.h>
#define FAR 70000
jmp_buf again;
char buffer[8], *taken;

int main(void)
{
  taken = malloc(100000);  // RS339: 100000
  memcpy(buffer, taken, 65536 + 4);  // RS339: 65536 + 4
  if (isalpha(-40000)) longjmp(again, FAR);  // RS339: -40000  // RS339: FAR
}
