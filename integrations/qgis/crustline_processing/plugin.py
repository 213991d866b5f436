"""The plugin: it registers the provider, and nothing else."""

from qgis.core import QgsApplication

from .provider import CrustlineProvider


class CrustlinePlugin:
    """What QGIS loads; without a window it asks for the provider alone."""

    def __init__(self, iface):
        self.provider = None

    def initProcessing(self):
        """Register the provider."""
        self.provider = CrustlineProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        """Register the provider in a QGIS with windows."""
        self.initProcessing()

    def unload(self):
        """Take the provider away."""
        QgsApplication.processingRegistry().removeProvider(self.provider)
