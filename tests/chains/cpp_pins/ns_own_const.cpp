#include "simpletools.h"
namespace pins{const int LED = 8;}
int main(){high(pins::LED);while(1)pause(100);}
