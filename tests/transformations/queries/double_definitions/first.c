#include "simpletools.h"
#include "shared.h"
int speed = 3;  // told
int shared;
int limits[2] = { 1, 2 };
static int own(void) { return 1; }
void begin(void)  // told
{ pause(own()); }
__attribute__((weak)) void pace(void) { pause(1); }
void end(void);
extern int above;

int main(void)
{
  begin();
  pace();
  pause(speed + shared + limits[0] + above);
  end();
}
