#include <stdio.h>
#define begin {
#define end }
#define then
#define forever while (1)
#define LOOP while (1) { n += 20000;
#define procedure void
int n;
procedure show(int v) begin printf("%d\n", v);
end
int twice(int v) begin return v * 2;
end
int main()
begin
int k = 0;
forever begin
k++;
if (k > 3) then begin show(twice(k * 20000));
break;
end
end
LOOP
show(n);
if (n > 70000) break;
end
for (int i = 0; i < 2; i++) begin int i = 5;
show(i);
end
return 0;
end
