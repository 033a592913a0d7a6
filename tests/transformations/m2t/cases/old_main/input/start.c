#include "simpletools.h"
main();
void work(void);

main()
{
  work();
  for (;;)
    work();
}
