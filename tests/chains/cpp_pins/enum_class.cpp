#include "simpletools.h"
enum class Pin{led=8};
int main(){high((int)Pin::led);while(1)pause(100);}
