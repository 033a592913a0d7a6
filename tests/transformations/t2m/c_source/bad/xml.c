<?xml version="1.0"?>
<module fritzingVersion="0.9">
  <instances></instances>
</module>
