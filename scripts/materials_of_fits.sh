# Sourced by what measures published fits: twenty of their materials.
metals="alum-bronze aluminium brass chrome-steel nickel black-oxidized-steel"
others="gold-metallic-paint red-metallic-paint silver-paint pearl-paint aventurnine blue-rubber cherry-235 dark-red-paint delrin
green-fabric pink-fabric specular-blue-phenolic teflon violet-acrylic"
