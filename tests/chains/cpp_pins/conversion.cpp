#include "simpletools.h"
struct Pin{int n;constexpr Pin(int x):n(x){}operator int()const{return n;}};
const Pin LED(8);
int main(){while(1){high(LED);pause(100);}}
