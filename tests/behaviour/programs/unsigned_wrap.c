#include <stdio.h>
unsigned u = 4294967290u; unsigned short w = 65534; unsigned char b = 254; unsigned long l = 4294967295ul;
unsigned before = 4294967000u, now = 500;
int main()
{
  int i;
  for (i = 0; i < 4; i++) { u += 3; w++; b++; printf("%u %d %d\n", u, w, b); }
  printf("%u\n", now - before);
  printf("%d\n", (int)(now - before) > 0);
  printf("%d\n", l + 1 == 0);
  printf("%d\n", -1 < 1u);
  printf("%d\n", (short)-1 < (unsigned short)1);
  printf("%d\n", u - 5 > 0);
  printf("%u\n", 0u - 1);
  printf("%u\n", (unsigned)(unsigned char)~0);
  printf("%d\n", sizeof(int) - 5 > 0);
  printf("%u\n", 3000000000u / 2 + 70000);
  printf("%d\n", (int)3000000000u);
  { unsigned short a = 50000, c = 50000; unsigned p = a + c; printf("%u\n", p); }
  { unsigned a = 65536; printf("%u\n", a * a); printf("%u\n", a * 65535u); }
  { long long q = 3000000000LL * 3; printf("%d\n", (int)(q / 1000000)); }
  { unsigned char a = 5, c = 10; int d = a - c; printf("%d %d\n", d, a - c < 0); }
  return 0;
}
