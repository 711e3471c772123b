"""Prints the folder below the prefix in which the interpreter looks for packages of its distribution."""

import sysconfig

DEBIAN = "deb_system"
scheme = DEBIAN if DEBIAN in sysconfig.get_scheme_names() else sysconfig.get_default_scheme()
prefixes = ("base", "platbase", "installed_base", "installed_platbase")
print(sysconfig.get_path("platlib", scheme, vars=dict.fromkeys(prefixes, "")).lstrip("/"))
