#define SHORT 40

// So many flashes, each followed by a rest.
void flash(int times)
{
  for(int i = 0; i < times; i++)
  {
    shine(SHORT);
    rest(2 * SHORT);
  }
}

int shine(int ms)
{
  high(3);
  pause(ms);
  low(3);
  return ms;
}

void rest(int ms) { pause(ms); }
