#include "simpletools.h"
struct G{int p;G(int x):p(x){high(p);}~G(){low(p);}};
int main(){while(1){{G g(8);pause(50);}pause(50);}}
