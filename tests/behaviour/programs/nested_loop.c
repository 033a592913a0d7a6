#include "simpletools.h"
int n;
int main()
{
  int i, found = 0, tries = 0;
  while (1)
  {
    for (i = 0; i < 10; i++) {
      if (i == 3) continue;
      if (i == 7) break;
      n += i;
    }
    tries++;
    if (tries % 2) continue;
    do {
      found++;
      if (found % 3 == 0) continue;
      if (found > 5) break;
    } while (found < 100);
    switch (tries) { case 2: n += 1000; break; case 4: n += 2000; continue; default: ; }
    printf("%d %d %d %d\n", i, n, tries, found);
    while (1) { if (found++ > 8) break; }
    if (tries > 10) break;
  }
  printf("left %d\n", found);
  for (i = 0; i < 3; i++) printf("after %d\n", i);
  return 3;
}
