"""crustline in the Processing toolbox of QGIS: curves from unordered points."""


def classFactory(iface):
    """Return the plugin, as QGIS asks for it."""
    from .plugin import CrustlinePlugin

    return CrustlinePlugin(iface)
