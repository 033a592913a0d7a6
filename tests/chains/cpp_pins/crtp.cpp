#include "simpletools.h"
template<class D> struct B{void on(){high(static_cast<D*>(this)->pin());}};
struct L:B<L>{int pin(){return 8;}};
L l;
int main(){while(1){l.on();pause(100);}}
