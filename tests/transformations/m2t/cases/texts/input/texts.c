#include "simpletools.h"
#define VERSION "1.0"

char *url = "http://example.org/*no comment*/";

int main()
{
  while (1) {
    print("v"VERSION"\n");
    print("%s // %c\n", url, VERSION[0]);
    pause(10);
  }
}
