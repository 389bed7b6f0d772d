"""viser's server as it runs here: for the console alone."""

import viser


class PrivateServer(viser.ViserServer):
    """Nobody who looks can have it open a tunnel to the internet, as viser's page offers."""

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Refused."""
        return None
