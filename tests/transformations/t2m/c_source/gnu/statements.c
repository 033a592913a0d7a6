#include "simpletools.h"
#define MAX(a,b) ({ int _a=(a), _b=(b); _a > _b ? _a : _b; })
int main(){ int p = ({ int q = 4; q; }); while(1){ int n = ({ int q=input(3); q+1; }); high(0); pause(30*n); low(({ pause(1); 0; })); pause(MAX(n, input(5))); high(p); if (({ toggle(1); n; })) pause(30);} }
