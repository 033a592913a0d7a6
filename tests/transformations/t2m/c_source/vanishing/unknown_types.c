#include "simpletools.h"
i2c *bus;
fdserial *term, *other = 0;
int main()
{
  i2c *b = i2c_newbus(28, 29, 0);
  datetime dt = dt_get();
  dt.h = 3;
  dt_set(dt);
  fdserial_txChar(term, 'x');
  print("%d", b->scl[2]);
}
/* expect: i2c_newbus dt_get dt_set fdserial_txChar print */
